#include "study/manifest.hpp"

#include "core/error.hpp"
#include "results/output_folder.hpp"
#include "study/batch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::study {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* ending_of_notes = ".part.json";

} // namespace

fs::path note_of_part(const fs::path& folder, const std::string& run) {
  return folder / (run + ending_of_notes);
}

std::optional<Json> read_manifest(const fs::path& folder) {
  const fs::path path = folder / manifest_file;
  if (!fs::exists(path)) return {};
  return Json::parse(results::read_file(path));
}

std::vector<Json> entries_of(const Json& manifest, const fs::path& folder) {
  std::vector<Json> entries;
  for (const Json& entry : manifest.at("runs")) entries.push_back(entry);
  std::vector<fs::path> notes;
  for (const auto& file : fs::directory_iterator(folder))
    if (file.path().filename().string().ends_with(ending_of_notes)) notes.push_back(file.path());
  std::sort(notes.begin(), notes.end());
  for (const fs::path& path : notes) {
    Json note = Json::parse(results::read_file(path));
    const auto same = std::find_if(entries.begin(), entries.end(),
                                   [&](const Json& entry) { return entry.at("name") == note.at("name"); });
    if (same != entries.end())
      *same = std::move(note);
    else
      entries.push_back(std::move(note));
  }
  return entries;
}

std::vector<RunNote> read_run_notes(const fs::path& folder, const std::string& kind) {
  if (!fs::is_directory(folder))
    throw InputError(
        fmt::format("there is no folder {}, expected the results of a {}", folder.string(), kind));
  try {
    const std::optional<Json> manifest = read_manifest(folder);
    if (!manifest)
      throw InputError(fmt::format("{} holds {}, expected the results of a {}", folder.string(),
                                   results::holds_run(folder) ? "a single run" : "no manifest.json of runs",
                                   kind));
    if (const std::string made = manifest->value("kind", "sweep"); made != kind)
      throw InputError(
          fmt::format("{} holds the runs of a {}, expected those of a {}", folder.string(), made, kind));
    std::vector<RunNote> notes;
    for (const Json& entry : entries_of(*manifest, folder)) {
      RunNote& note = notes.emplace_back();
      note.name = entry.at("name");
      note.done = entry.at("state") == state_name(RunRecord::State::done);
      if (!note.done)
        note.reason =
            fmt::format("{}{}", entry.at("state").get<std::string>(),
                        entry.contains("reason") ? ": " + entry.at("reason").get<std::string>() : "");
    }
    return notes;
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("{} is not the manifest of a {}: {}", (folder / manifest_file).string(), kind,
                              error.what()));
  }
}

} // namespace cnem::study
