#pragma once
// manifest.json of a study: how its runs stand, for later calls. For study/batch.cpp and those who read
// finished studies.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

inline constexpr const char* manifest_file = "manifest.json";

/// Where a part notes how its run stands; no run has a name that ends in .json.
std::filesystem::path note_of_part(const std::filesystem::path& folder, const std::string& run);

/// The manifest of an earlier call; none when there is none. Throws Json::exception for what is none.
std::optional<nlohmann::ordered_json> read_manifest(const std::filesystem::path& folder);

/// What earlier calls have left of each run, in the order of the manifest: the note of a part, or else its
/// entry there; then the notes of others. Throws Json::exception.
std::vector<nlohmann::ordered_json> entries_of(const nlohmann::ordered_json& manifest,
                                               const std::filesystem::path& folder);

/// What a folder says of the runs of a finished study.
struct RunNote {
  std::string name;
  bool done = false;
  std::string reason; ///< why it is not
};
/// Throws InputError where the folder holds no runs of this kind ("sweep"), IoError where its manifest cannot
/// be read.
std::vector<RunNote> read_run_notes(const std::filesystem::path& folder, const std::string& kind);

} // namespace cnem::study
