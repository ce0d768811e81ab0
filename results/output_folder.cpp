#include "results/output_folder.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "input/left_workpiece.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/status.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <set>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace cnem::results {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const std::string& action, const fs::path& path, const std::string& reason) {
  throw IoError(fmt::format("cannot {} {}: {}", action, path.string(), reason));
}

[[noreturn]] void fail(const std::string& action, const fs::path& path, int error) {
  fail(action, path, std::error_code(error, std::generic_category()).message());
}

// A name that no other process writing the same file uses.
fs::path beside(const fs::path& target) {
  return target.parent_path() / fmt::format(".{}.{}.tmp", target.filename().string(), getpid());
}

// A file descriptor that closes itself.
class Descriptor {
public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return fd_; }

private:
  int fd_;
};

// The entry of the folder must reach the disk too, or a crash may leave neither name. Some file systems
// cannot do it; they are no worse off than without.
void flush_folder(const fs::path& folder) {
  const Descriptor fd(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY));
  if (fd >= 0) ::fsync(fd);
}

void replace(const fs::path& temporary, const fs::path& target) {
  std::error_code error;
  fs::rename(temporary, target, error);
  if (error) fail("write", target, error.message());
  flush_folder(target.parent_path());
}

enum class Flush { begin, wait };

// Failures are told of `target`, the name that the user knows.
void write_whole(const fs::path& path, const fs::path& target, std::string_view content, Flush flush) {
  const Descriptor fd(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
  if (fd < 0) fail("write", target, errno);
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t n = ::write(fd, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("write", target, n < 0 ? errno : ENOSPC);
    done += index_of(n);
  }
  if (flush == Flush::begin)
    ::sync_file_range(fd, 0, 0, SYNC_FILE_RANGE_WRITE); // a hint: who needs it on the disk flushes it
  else if (::fsync(fd) != 0)
    fail("write", target, errno);
}

// A name that is free again when this goes, unless the file has been renamed.
struct Temporary {
  fs::path path;
  explicit Temporary(fs::path name) : path(std::move(name)) {}
  Temporary(Temporary&& other) noexcept : path(std::move(other.path)) { other.path.clear(); }
  Temporary& operator=(Temporary&&) = delete;
  ~Temporary() {
    std::error_code ignored;
    if (!path.empty()) fs::remove(path, ignored);
  }
};

bool is_numbered(const fs::path& file, const char* folder, const char* extension) {
  return file.parent_path().filename() == folder && file.extension() == extension;
}

// Files left beside their target by a killed run.
bool is_temporary(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with('.') && name.ends_with(".tmp");
}

} // namespace

fs::path file_in(const fs::path& folder, const char* name) {
  return folder.empty() ? fs::path() : folder / name;
}

void write_atomically(const fs::path& path, std::string_view content) { AtomicFile(path, content).commit(); }

void write_atomically(std::span<const FileContent> files) {
  std::vector<Temporary> temporary;
  for (const FileContent& file : files) temporary.emplace_back(beside(file.path));
  for (std::size_t k = 0; k < files.size(); ++k)
    write_whole(temporary[k].path, files[k].path, files[k].content, Flush::begin);
  for (std::size_t k = 0; k < files.size(); ++k) {
    const Descriptor fd(::open(temporary[k].path.c_str(), O_RDONLY));
    if (fd < 0 || ::fsync(fd) != 0) fail("write", files[k].path, errno);
  }
  std::set<fs::path> folders;
  for (std::size_t k = 0; k < files.size(); ++k) {
    std::error_code error;
    fs::rename(temporary[k].path, files[k].path, error);
    if (error) fail("write", files[k].path, error.message());
    folders.insert(files[k].path.parent_path());
  }
  for (const fs::path& folder : folders) flush_folder(folder);
}

AtomicFile::AtomicFile(fs::path target, std::string_view content)
    : target_(std::move(target)), temporary_(beside(target_)) {
  try {
    write_whole(temporary_, target_, content, Flush::wait);
  } catch (...) {
    discard();
    throw;
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_) discard();
}

void AtomicFile::discard() {
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  replace(temporary_, target_);
  committed_ = true;
}

void flush_file(const fs::path& path) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY));
  if (fd < 0 || ::fsync(fd) != 0) fail("write", path, errno);
}

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) fail("read", path, "it is a folder");
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd < 0) fail("read", path, errno);
  std::string content;
  for (std::size_t size = 0;;) {
    content.resize(size + (std::size_t{1} << 16));
    const ssize_t n = ::read(fd, content.data() + size, content.size() - size);
    if (n < 0 && errno != EINTR) fail("read", path, errno);
    if (n > 0) size += index_of(n);
    content.resize(size);
    if (n == 0) return content;
  }
}

namespace {

constexpr std::array run_files{files::resolved_case,
                               files::history,
                               files::adaptation,
                               files::fields,
                               files::tool_fields,
                               files::checkpoint,
                               files::blanking,
                               files::cutting_course,
                               files::cutting,
                               files::experiment,
                               files::stability,
                               files::stability_chart,
                               files::stability_picture,
                               files::stability_places,
                               files::modes,
                               files::mode_shapes,
                               files::machined_surface,
                               files::machined_surface_grid,
                               input::left_workpiece,
                               files::spectra,
                               files::status,
                               files::report};
constexpr std::array run_folders{files::fields_folder, files::pictures_folder, files::lines_folder,
                                 files::cutting_folder};

// Every file in the folder that a run makes, and nothing else.
std::vector<fs::path> files_of_a_run(const fs::path& folder) {
  std::vector<fs::path> found;
  const auto collect = [&](const fs::path& where, auto&& belongs) {
    std::error_code error;
    if (!fs::is_directory(where, error)) return;
    for (const fs::directory_entry& entry : fs::directory_iterator(where, error))
      if (!entry.is_directory() && (belongs(entry.path()) || is_temporary(entry.path())))
        found.push_back(entry.path());
    if (error) fail("read", where, error.message());
  };
  collect(folder, [](const fs::path& file) {
    const std::string name = file.filename().string();
    for (const char* own : run_files)
      if (name == own) return true;
    return name.starts_with("checkpoint") && file.extension() == ".h5";
  });
  collect(folder / files::fields_folder,
          [](const fs::path& file) { return is_numbered(file, files::fields_folder, ".vtu"); });
  collect(folder / files::pictures_folder, [](const fs::path& file) {
    return is_numbered(file, files::pictures_folder, ".png") || file.filename() == "index.json";
  });
  for (const char* tables : {files::lines_folder, files::cutting_folder})
    collect(folder / tables, [](const fs::path& file) { return file.extension() == ".csv"; });
  return found;
}

} // namespace

namespace {

// A file of a run in the folder, "" when there is none. What a killed run left half-written is no run.
fs::path any_file_of_a_run(const fs::path& folder) {
  for (const fs::path& file : files_of_a_run(folder))
    if (!is_temporary(file)) return file;
  return {};
}

} // namespace

bool holds_run(const fs::path& folder) { return !any_file_of_a_run(folder).empty(); }

namespace {

template<class Keep> void remove_files_of_a_run(const fs::path& folder, Keep&& keep) {
  std::error_code error;
  for (const fs::path& file : files_of_a_run(folder)) {
    if (keep(file.filename().string())) continue;
    fs::remove(file, error);
    if (error) fail("remove", file, error.message());
  }
  for (const char* sub : run_folders) fs::remove(folder / sub, error); // only when empty
}

/// Whether a run was stopped or killed before its end, and left something to go on from.
bool is_unfinished(const fs::path& folder) {
  if (list_checkpoints(folder).empty()) return false;
  if (!fs::exists(folder / files::status)) return true;
  try {
    return read_status(folder).exit == Exit::interrupted;
  } catch (const IoError&) { return false; }
}

} // namespace

void clear_results(const fs::path& folder) {
  remove_files_of_a_run(folder, [](const std::string& name) {
    return name == files::resolved_case || name.starts_with(files::refused_checkpoint);
  });
}

void clear_leftovers(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : files_of_a_run(folder))
    if (is_temporary(file)) fs::remove(file, ignored);
}

void prepare_output_folder(const fs::path& folder, bool force) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    fail("create the output folder", folder, error ? error.message() : "a file of this name is in the way");
  const fs::path old = any_file_of_a_run(folder);
  if (!old.empty() &&
      old.lexically_relative(folder).has_parent_path()) // pictures and fields of somebody else
    throw InputError(
        fmt::format("the output folder {} holds {}, which a run would replace, and no run: choose "
                    "another with --output",
                    folder.string(), fs::relative(old, folder).string()));
  if (!old.empty() && !force)
    throw InputError(
        fmt::format("the output folder {} already holds a run ({}): {}choose another with --output, "
                    "or replace it with --force",
                    folder.string(), fs::relative(old, folder).string(),
                    is_unfinished(folder) ? "`cnem restart` goes on with it; or " : ""));
  remove_files_of_a_run(folder, [](const std::string&) { return false; });
  check_writable(folder);
}

void check_writable(const fs::path& folder) {
  const fs::path probe = beside(folder / "probe");
  {
    const Descriptor fd(::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
    if (fd < 0) fail("write in the output folder", folder, errno);
  }
  std::error_code error;
  fs::remove(probe, error);
}

} // namespace cnem::results
