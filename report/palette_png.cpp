#include "report/palette_png.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <fmt/format.h>

#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem::report {
namespace {

constexpr std::size_t shaded_colours = 40, greys = 31; // and one for what is invalid

constexpr int channel(std::uint32_t pixel, int k) { return static_cast<int>(pixel >> (16 - 8 * k) & 0xFFU); }

std::uint32_t packed(const Colour& colour, double factor) {
  std::uint32_t pixel = 0;
  for (const double c : {colour.red, colour.green, colour.blue})
    pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(255.0 * factor * c));
  return pixel;
}

// Looks up colours of a palette.
class Palette {
public:
  explicit Palette(std::span<const std::uint32_t> colours) : size_(colours.size()) {
    for (std::size_t k = 0; k < size_; ++k)
      for (int c = 0; c < 3; ++c) channel_[index_of(c)][k] = channel(colours[k], c);
  }

  std::uint8_t nearest(std::uint32_t pixel) {
    Known& known = known_[pixel * 2654435761U >> 18];
    if (known.pixel != pixel) known = {pixel, search(pixel)};
    return known.index;
  }

private:
  struct Known {
    std::uint32_t pixel = 0xFFFFFFFF; // no pixel
    std::uint8_t index = 0;
  };

  std::uint8_t search(std::uint32_t pixel) const {
    std::array<int, 256> distance;
    for (std::size_t k = 0; k < size_; ++k) {
      const int red = channel_[0][k] - channel(pixel, 0), green = channel_[1][k] - channel(pixel, 1),
                blue = channel_[2][k] - channel(pixel, 2);
      distance[k] = red * red + green * green + blue * blue;
    }
    return static_cast<std::uint8_t>(
        std::min_element(distance.begin(), distance.begin() + static_cast<std::ptrdiff_t>(size_)) -
        distance.begin());
  }

  std::size_t size_;
  std::array<std::array<int, 256>, 3> channel_;
  std::vector<Known> known_ = std::vector<Known>(std::size_t{1} << 14); // by the pixel's hash
};

} // namespace

std::vector<std::uint32_t> drawing_palette(ColourMap map, double shade) {
  std::vector<std::uint32_t> palette;
  const auto ramp = [&](std::size_t count, auto&& colour) {
    for (std::size_t k = 0; k < count; ++k)
      palette.push_back(colour(static_cast<double>(k) / static_cast<double>(count - 1)));
  };
  ramp(drawing_levels, [&](double s) { return packed(map_colour(map, s), 1.0); });
  for (const double part : {0.5, 1.0}) // lines cover some pixels by halves
    ramp(shaded_colours, [&](double s) { return packed(map_colour(map, s), 1.0 - part * shade); });
  ramp(greys, [](double s) { return packed({1.0, 1.0, 1.0}, s); });
  palette.push_back(packed(invalid_colour, 1.0));
  return palette;
}

std::vector<std::uint8_t> nearest_colours(const PixelView& pixels, std::span<const std::uint32_t> palette) {
  std::vector<std::uint8_t> index;
  index.reserve(index_of(pixels.width) * index_of(pixels.height));
  Palette colours(palette);
  for (int y = 0; y < pixels.height; ++y) {
    const auto row = pixels.row(y);
    for (std::size_t x = 0; x < row.size();) {
      std::size_t next = x + 1;
      while (next < row.size() && row[next] == row[x]) ++next;
      index.insert(index.end(), next - x, colours.nearest(row[x] & 0xFFFFFFU));
      x = next;
    }
  }
  return index;
}

std::string palette_png(const PixelView& pixels, std::span<const std::uint32_t> palette) {
  const std::vector<std::uint8_t> index = nearest_colours(pixels, palette);
  std::vector<png_byte> colours;
  for (const std::uint32_t colour : palette)
    for (int k = 0; k < 3; ++k) colours.push_back(static_cast<png_byte>(channel(colour, k)));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(pixels.width);
  image.height = static_cast<png_uint_32>(pixels.height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.flags =
      PNG_IMAGE_FLAG_FAST; // no filters, zlib's level 3: less than half the time, a seventh more bytes
  image.colormap_entries = static_cast<png_uint_32>(palette.size());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string png(size, '\0');
  if (!png_image_write_to_memory(&image, png.data(), &size, 0, index.data(), 0, colours.data()))
    throw IoError(fmt::format("cannot encode a picture: {}", image.message));
  png.resize(size);
  return png;
}

} // namespace cnem::report
