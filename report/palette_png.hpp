#pragma once
// PNG files of drawings with few colours, a byte a pixel: a third of true colour's.
#include "core/index.hpp"
#include "report/colour_map.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::report {

/// Pixels as 0x00RRGGBB (the upper byte is ignored), rows of `width` one `stride` after the other.
struct PixelView {
  const std::uint32_t* first = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0; ///< pixels

  std::span<const std::uint32_t> row(int y) const { return {first + index_of(y) * stride, index_of(width)}; }
};

/// Colours of a drawing that are its colour map's, at equal distances from 0 to 1.
inline constexpr int drawing_levels = 144;

/// 0x00RRGGBB.
std::uint32_t packed(const Colour& colour);

/// What a picture of a field is drawn with: `drawing_levels` of the colour map, fewer darkened by `shade`
/// (lines between cells) and by half of it, greys from black to white, and the colour of invalid values. 256
/// colours as 0x00RRGGBB.
std::vector<std::uint32_t> drawing_palette(ColourMap map, double shade);

/// The same for surfaces under light: eight brightnesses of fewer levels, down to 1 − `darkest`.
std::vector<std::uint32_t> lit_palette(ColourMap map, double darkest);
/// Colours of it that are its colour map's, at equal distances from 0 to 1.
inline constexpr int lit_levels = 28;

/// For each pixel the number of the drawing palette's colour nearest to its own, the first of equals; [y ·
/// width + x]. Grey pixels take greys and others do not: a dark page turns greys round, cells stay as they
/// are.
std::vector<std::uint8_t> nearest_colours(const PixelView& pixels, std::span<const std::uint32_t> palette);

/// A drawing of at most 256 colours.
struct PaletteImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> index;    ///< [y · width + x] of the colour in `palette`
  std::vector<std::uint32_t> palette; ///< 0x00RRGGBB
};

/// The image as a PNG file. Throws IoError.
std::string palette_png(const PaletteImage& image);

/// Bytes of a PNG file that others may stand in place of.
struct PngPatch {
  std::size_t offset = 0;
  std::string bytes;
};
/// What makes a picture of a drawing palette one on a dark page (report/report_style.hpp): its chunk of
/// colours, in which greys run from light ink to the page's card. None for a file with other colours.
std::optional<PngPatch> dark_patch(std::string_view png);

} // namespace cnem::report
