#pragma once
// The pictures of a run.
#include "app/snapshot.hpp"
#include "io/case.hpp"
#include "io/picture.hpp"
#include "io/picture_album.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace cnem::app {

/// Draws the case's pictures, in the background from a copy of what they show.
class PictureRecorder {
public:
  PictureRecorder(const io::Case& input, const std::filesystem::path& folder)
      : case_(&input), album_(folder) {}
  void record(io::FileQueue& files, const Snapshot& shot);
  /// Draws the plastic strain around a place that went wrong, within `radius` (m). Returns the file's name in
  /// the folder of pictures.
  std::string record_place(io::FileQueue& files, const Snapshot& shot, const Vec2& centre, double radius);
  /// Drops the pictures later than `time` (s).
  void truncate(double time) { album_.truncate(time); }

private:
  struct Kept;
  io::Picture picture_of(const Snapshot& shot, const std::string& field, Kept& kept, Field values) const;
  std::string draw(io::FileQueue& files, const std::shared_ptr<const Kept>& kept, const io::Picture& picture,
                   const std::string& key, const std::string& caption, const std::string& note = "");
  std::string note_of(double time, const std::string& field) const;
  const io::Case* case_;
  io::PictureAlbum album_;
};

} // namespace cnem::app
