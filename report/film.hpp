#pragma once
// Films from drawings: GIF, animated WebP and, where ffmpeg is installed, MP4.
#include "report/palette_png.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace cnem::report {

/// Takes the frames of a film one after the other; all have the same size and palette.
class FilmEncoder {
public:
  virtual ~FilmEncoder() = default;
  /// Shown for `centiseconds`. Throws IoError.
  virtual void add(const PaletteImage& frame, int centiseconds) = 0;
  /// The film as a file, complete. Throws IoError.
  virtual std::string finish() = 0;
};

/// Without loss, again and again; a frame holds what differs from the one before.
std::unique_ptr<FilmEncoder> gif_encoder();
std::unique_ptr<FilmEncoder> webp_encoder();

/// Makes `mp4` of a GIF file by ffmpeg. Throws InputError where it is not installed, IoError where it fails.
void convert_to_mp4(const std::filesystem::path& gif, const std::filesystem::path& mp4);

} // namespace cnem::report
