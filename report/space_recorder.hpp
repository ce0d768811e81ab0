#pragma once
// The pictures of a run in space: its surface as an eye sees it, and cuts through its cells.
#include "input/case.hpp"
#include "report/picture_album.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <string>

namespace cnem::report {

/// Draws the case's pictures, in the background from a copy of what they show. Each has a scale of its own
/// unless the case gives the range of its field.
class SpaceRecorder {
public:
  /// `input` must outlive this object.
  SpaceRecorder(const input::Case& input, const std::filesystem::path& folder)
      : case_(&input), album_(folder) {}
  void record(results::FileQueue& files, const results::Snapshot<3>& shot);
  /// Drops the pictures later than `time` (s).
  void truncate(double time) { album_.truncate(time); }

private:
  const input::Case* case_;
  PictureAlbum album_;
};

} // namespace cnem::report
