#pragma once
// The pictures of a run in space: its surface with tools as an eye sees it, and cuts through its cells.
#include "report/picture_album.hpp"
#include "report/space_source.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cnem::report {

/// Draws the case's pictures, in the background from a copy of what they show.
class SpaceRecorder {
public:
  /// `input` must outlive this object.
  SpaceRecorder(const input::Case& input, const std::filesystem::path& folder)
      : case_(&input), folder_(folder), album_(folder) {}
  /// Draws the present time, each picture with a scale of its own.
  void record(results::FileQueue& files, const results::Snapshot<3>& shot);
  /// Draws those anew whose series needs another scale, from fields.pvd, which has to be on the disk. Throws
  /// IoError.
  void finish(results::FileQueue& files);
  /// Drops the pictures later than `time` (s).
  void truncate(double time) { album_.truncate(time); }

private:
  const std::vector<TriangleSurface>& tools();

  const input::Case* case_;
  std::filesystem::path folder_;
  PictureAlbum album_;
  std::vector<TriangleSurface> tools_; ///< made when they are asked for first
};

} // namespace cnem::report
