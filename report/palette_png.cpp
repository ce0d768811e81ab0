#include "report/palette_png.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <fmt/format.h>

#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cnem::report {
namespace {

constexpr std::size_t shaded_colours = 40, greys = 31; // and one for what is invalid
constexpr std::size_t first_grey = drawing_levels + 2 * shaded_colours;

constexpr int channel(std::uint32_t pixel, int k) { return static_cast<int>(pixel >> (16 - 8 * k) & 0xFFU); }

std::uint32_t darkened(const Colour& colour, double factor) {
  std::uint32_t pixel = 0;
  for (const double c : {colour.red, colour.green, colour.blue})
    pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(255.0 * factor * c));
  return pixel;
}

// Looks up colours of a palette, which is searched outwards from the pixel's green.
class Palette {
public:
  /// Those from `begin` to `end`, or with `others` all but those.
  Palette(std::span<const std::uint32_t> colours, std::size_t begin, std::size_t end, bool others = false) {
    for (std::size_t k = 0; k < colours.size(); ++k)
      if ((k >= begin && k < end) != others)
        entry_.push_back({channel(colours[k], 0), channel(colours[k], 1), channel(colours[k], 2),
                          static_cast<std::uint8_t>(k)});
    std::stable_sort(entry_.begin(), entry_.end(),
                     [](const Entry& a, const Entry& b) { return a.green < b.green; });
    for (const Entry& entry : entry_) ++first_[index_of(entry.green) + 1];
    for (std::size_t green = 0; green < 256; ++green) first_[green + 1] += first_[green];
  }

  std::uint8_t nearest(std::uint32_t pixel) {
    Known& known = known_[pixel * 2654435761U >> 18];
    if (known.pixel != pixel) known = {pixel, search(pixel)};
    return known.index;
  }

private:
  struct Entry {
    int red, green, blue;
    std::uint8_t index; ///< in the palette
  };
  struct Known {
    std::uint32_t pixel = 0xFFFFFFFF; // no pixel
    std::uint8_t index = 0;
  };

  std::uint8_t search(std::uint32_t pixel) const {
    const int red = channel(pixel, 0), green = channel(pixel, 1), blue = channel(pixel, 2);
    std::pair<int, std::uint8_t> best{std::numeric_limits<int>::max(), 0}; // distance, the first of equals
    const auto apart = [&](const Entry& e) { return (e.green - green) * (e.green - green); };
    const auto look = [&](const Entry& e) {
      best = std::min(
          best, {(e.red - red) * (e.red - red) + apart(e) + (e.blue - blue) * (e.blue - blue), e.index});
    };
    const auto middle = entry_.begin() + first_[index_of(green)];
    for (auto e = middle; e != entry_.end() && apart(*e) <= best.first; ++e) look(*e);
    for (auto e = middle; e != entry_.begin() && apart(*(e - 1)) <= best.first; --e) look(*(e - 1));
    return best.second;
  }

  std::vector<Entry> entry_;                ///< by green
  std::array<std::ptrdiff_t, 257> first_{}; ///< [green] the first entry with as much or more
  std::vector<Known> known_ = std::vector<Known>(std::size_t{1} << 14); // by the pixel's hash
};

} // namespace

std::uint32_t packed(const Colour& colour) { return darkened(colour, 1.0); }

std::vector<std::uint32_t> drawing_palette(ColourMap map, double shade) {
  std::vector<std::uint32_t> palette;
  const auto ramp = [&](std::size_t count, auto&& colour) {
    for (std::size_t k = 0; k < count; ++k)
      palette.push_back(colour(static_cast<double>(k) / static_cast<double>(count - 1)));
  };
  ramp(drawing_levels, [&](double s) { return packed(map_colour(map, s)); });
  for (const double part : {0.5, 1.0}) // lines cover some pixels by halves
    ramp(shaded_colours, [&](double s) { return darkened(map_colour(map, s), 1.0 - part * shade); });
  ramp(greys, [](double s) { return darkened({1.0, 1.0, 1.0}, s); });
  palette.push_back(packed(invalid_colour));
  return palette;
}

std::vector<std::uint32_t> lit_palette(ColourMap map, double darkest) {
  constexpr std::size_t brightnesses = first_grey / lit_levels;
  static_assert(brightnesses * lit_levels == first_grey);
  std::vector<std::uint32_t> palette;
  for (std::size_t b = 0; b < brightnesses; ++b)
    for (int k = 0; k < lit_levels; ++k)
      palette.push_back(darkened(map_colour(map, static_cast<double>(k) / (lit_levels - 1)),
                                 1.0 - darkest * static_cast<double>(b) / (brightnesses - 1)));
  const std::vector<std::uint32_t> drawing = drawing_palette(map, 0.0);
  palette.insert(palette.end(), drawing.begin() + first_grey, drawing.end());
  return palette;
}

std::vector<std::uint8_t> nearest_colours(const PixelView& pixels, std::span<const std::uint32_t> palette) {
  std::vector<std::uint8_t> index;
  index.reserve(index_of(pixels.width) * index_of(pixels.height));
  Palette grey(palette, first_grey, first_grey + greys),
      coloured(palette, first_grey, first_grey + greys, true);
  for (int y = 0; y < pixels.height; ++y) {
    const auto row = pixels.row(y);
    for (std::size_t x = 0; x < row.size();) {
      std::size_t next = x + 1;
      while (next < row.size() && row[next] == row[x]) ++next;
      const std::uint32_t pixel = row[x] & 0xFFFFFFU;
      const bool neutral = pixel == (pixel & 0xFFU) * 0x10101U;
      index.insert(index.end(), next - x, (neutral ? grey : coloured).nearest(pixel));
      x = next;
    }
  }
  return index;
}

std::string palette_png(const PaletteImage& drawn) {
  std::vector<png_byte> colours;
  for (const std::uint32_t colour : drawn.palette)
    for (int k = 0; k < 3; ++k) colours.push_back(static_cast<png_byte>(channel(colour, k)));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(drawn.width);
  image.height = static_cast<png_uint_32>(drawn.height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.flags =
      PNG_IMAGE_FLAG_FAST; // no filters, zlib's level 3: less than half the time, a seventh more bytes
  image.colormap_entries = static_cast<png_uint_32>(drawn.palette.size());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string png(size, '\0');
  if (!png_image_write_to_memory(&image, png.data(), &size, 0, drawn.index.data(), 0, colours.data()))
    throw IoError(fmt::format("cannot encode a picture: {}", image.message));
  png.resize(size);
  return png;
}

namespace {

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t k = at; k < at + 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes[k]);
  return number;
}

/// Where the data of the chunk of colours begin; 0 if it has not 256, or there is none.
std::size_t palette_data(std::string_view png) {
  constexpr std::size_t signature = 8, head = 8, checksum = 4; // of the file, before and after data
  for (std::size_t at = signature; at + head <= png.size();) {
    const std::size_t length = number_at(png, at);
    if (png.substr(at + 4, 4) == "PLTE")
      return length == 768 && at + head + length + checksum <= png.size() ? at + head : 0;
    at += head + length + checksum;
  }
  return 0;
}

} // namespace

std::optional<PngPatch> dark_patch(std::string_view png) {
  constexpr std::array<double, 3> ink{232, 235, 240}, card{27, 32, 39}; // of the dark page
  const std::size_t data = palette_data(png);
  if (data == 0) return {};
  PngPatch patch{data, std::string(png.substr(data, 768))};
  for (std::size_t k = 0; k < greys; ++k) {
    const std::size_t first = 3 * (first_grey + k);
    const double s = static_cast<double>(k) / static_cast<double>(greys - 1);
    const auto grey = static_cast<char>(std::lround(255.0 * s));
    for (std::size_t c = 0; c < 3; ++c) {
      if (patch.bytes[first + c] != grey) return {};
      patch.bytes[first + c] = static_cast<char>(std::lround((1.0 - s) * ink[c] + s * card[c]));
    }
  }
  // The checksum covers the name too, which stands before the data.
  const std::string covered = "PLTE" + patch.bytes;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(covered.data()), static_cast<uInt>(covered.size()));
  for (const int shift : {24, 16, 8, 0}) patch.bytes += static_cast<char>(sum >> shift & 0xFFU);
  return patch;
}

} // namespace cnem::report
