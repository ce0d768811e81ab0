#include "results/checkpoint_folder.hpp"

#include "core/error.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

namespace cnem::results {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view stem = "checkpoint";

std::string name_of(int age) { return age == 0 ? files::checkpoint : fmt::format("{}.{}.h5", stem, age); }

/// How many younger ones a file of this name has; −1 when it is no checkpoint.
int age_of(std::string_view name) {
  if (name == files::checkpoint) return 0;
  int age = -1;
  constexpr std::string_view before = "checkpoint.";
  if (name.starts_with(before)) {
    std::from_chars(name.data() + before.size(), name.data() + name.size(), age);
    if (age < 1 || name != name_of(age)) return -1;
  }
  return age;
}

std::map<int, fs::path> by_age(const fs::path& folder) {
  std::map<int, fs::path> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (const int age = age_of(entry.path().filename().string()); age >= 0) found[age] = entry.path();
  if (error) throw IoError(fmt::format("cannot read {}: {}", folder.string(), error.message()));
  return found;
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw IoError(fmt::format("cannot rename {} to {}: {}", from.string(), to.string(), error.message()));
}

} // namespace

void add_checkpoint(const fs::path& folder, std::string_view content, int keep) {
  AtomicFile file(folder / files::checkpoint, content);
  const std::map<int, fs::path> old = by_age(folder);
  for (auto entry = old.rbegin(); entry != old.rend(); ++entry) {
    const auto& [age, path] = *entry;
    std::error_code error;
    if (age + 1 >= keep && age > 0)
      fs::remove(path, error);
    else if (age > 0)
      move(path, folder / name_of(age + 1));
    else if (keep > 1) {
      // A second name for the newest one, so that checkpoint.h5 is there all the time.
      fs::create_hard_link(path, folder / name_of(1), error);
      if (error) move(path, folder / name_of(1)); // file systems without links
    }
  }
  file.commit();
}

std::vector<fs::path> list_checkpoints(const fs::path& folder) {
  std::vector<fs::path> list;
  for (auto& [age, path] : by_age(folder)) list.push_back(std::move(path));
  return list;
}

void set_aside(const fs::path& checkpoint) {
  const std::string name = checkpoint.filename().string();
  move(checkpoint, checkpoint.parent_path() / (files::refused_checkpoint + name.substr(stem.size())));
}

} // namespace cnem::results
