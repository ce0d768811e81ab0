#pragma once
// The pictures of a run.
#include "input/case.hpp"
#include "report/picture_album.hpp"
#include "report/picture_source.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cnem::report {

/// A window of a case, where the tool that it follows has taken it. tools: all of the case, as they stand.
PictureWindow window_at(const input::Window& window, const std::vector<PictureTool>& tools);

/// Draws the case's pictures, in the background from a copy of what they show.
class PictureRecorder {
public:
  PictureRecorder(const input::Case& input, const std::filesystem::path& folder)
      : case_(&input), folder_(folder), album_(folder) {}
  /// Draws the present time, each picture with a scale of its own.
  void record(results::FileQueue& files, const results::Snapshot<2>& shot);
  /// Draws those anew whose series needs another scale, from fields.pvd, which has to be on the disk. Throws
  /// IoError.
  void finish(results::FileQueue& files);
  /// Draws the plastic strain around a place that went wrong, within `radius` (m). Returns the file's name in
  /// the folder of pictures.
  std::string record_place(results::FileQueue& files, const results::Snapshot<2>& shot, const Vec2& centre,
                           double radius);
  /// Drops the pictures later than `time` (s).
  void truncate(double time) { album_.truncate(time); }

private:
  using Source = std::shared_ptr<PictureSource>;
  std::string draw(results::FileQueue& files, const Source& source, Picture picture, const std::string& key,
                   AlbumEntry entry);
  std::string note_of(double time, const std::string& field) const;
  const input::Case* case_;
  std::filesystem::path folder_;
  PictureAlbum album_;
};

} // namespace cnem::report
