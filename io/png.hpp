#pragma once
// PNG files of drawings: a palette of 256 colours, a third of the bytes of true colour.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cnem::io {

/// Pixels as 0x00RRGGBB, rows of `width` one `stride` after the other.
struct PixelView {
  const std::uint32_t* first = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0; ///< pixels

  std::span<const std::uint32_t> row(int y) const {
    return {first + static_cast<std::size_t>(y) * stride, static_cast<std::size_t>(width)};
  }
};

/// Colours with an index into them for each pixel.
struct IndexedPixels {
  std::vector<std::uint32_t> palette; ///< 0x00RRGGBB, at most 256
  std::vector<std::uint8_t> index;    ///< [y · width + x]
};

/// The colours that stand for those of the picture with the least squared error found by halving boxes; exact
/// for pictures of few colours.
IndexedPixels reduce_colours(const PixelView& pixels);

/// The picture as a PNG file with a palette. Throws IoError when it cannot be compressed.
std::string indexed_png(const PixelView& pixels);

} // namespace cnem::io
