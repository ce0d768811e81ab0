#include "io/cell_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem::io {
namespace {

constexpr int oversampling = 3, samples = oversampling * oversampling;
constexpr int band_height = 32; ///< px: the samples of a band of the picture stay in the cache
constexpr int levels = 256;
constexpr std::uint16_t invalid_level = levels, level_mask = 0x1FF, edge_flag = 0x200, painted = 0x400;
constexpr Colour rim_colour{0.12, 0.13, 0.16};

struct Rgb {
  int red = 0, green = 0, blue = 0;
};

Rgb rgb_of(const Colour& colour, double factor = 1.0) {
  const auto byte = [&](double c) { return static_cast<int>(std::lround(255.0 * factor * c)); };
  return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

constexpr std::uint32_t packed(const Rgb& c) {
  return static_cast<std::uint32_t>(c.red) << 16 | static_cast<std::uint32_t>(c.green) << 8 |
         static_cast<std::uint32_t>(c.blue);
}

constexpr Rgb unpacked(std::uint32_t pixel) {
  return {static_cast<int>(pixel >> 16 & 0xFFU), static_cast<int>(pixel >> 8 & 0xFFU),
          static_cast<int>(pixel & 0xFFU)};
}

// Colour of a sample, by its level with or without the flag of an edge.
using SampleColours = std::vector<Rgb>;

SampleColours sample_colours(const CellPaint& paint) {
  SampleColours colours(2 * edge_flag);
  for (const bool edge : {false, true}) {
    const double factor = edge ? 1.0 - paint.strength : 1.0;
    const std::size_t first = edge ? edge_flag : 0;
    for (std::size_t k = 0; k < levels; ++k)
      colours[first + k] = rgb_of(map_colour(paint.map, static_cast<double>(k) / (levels - 1)), factor);
    colours[first + invalid_level] = rgb_of(invalid_colour, factor);
  }
  return colours;
}

std::uint16_t level_of(const CellPaint& paint, std::size_t cell) {
  const double s = (paint.value[cell] - paint.range.low) / (paint.range.high - paint.range.low);
  return std::isnan(s) ? invalid_level
                       : static_cast<std::uint16_t>(std::lround(std::clamp(s, 0.0, 1.0) * (levels - 1)));
}

/// The samples of some rows of the picture.
struct Band {
  int top = 0, width = 0, height = 0; ///< samples
  std::vector<std::uint16_t> sample;

  std::uint16_t* row(int y) {
    return sample.data() + static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width);
  }
};

// In samples; the outline is closed.
using Outline = std::vector<Vec2>;

int first_centre(double x, int limit) { // least integer k with k + ½ ≥ x
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(limit)));
}

void fill(Band& band, const Outline& outline, std::uint16_t value, std::vector<double>& crossing) {
  double low = outline.front().y(), high = low;
  for (const Vec2& p : outline) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  const int end = std::min(first_centre(high, band.top + band.height), band.top + band.height);
  for (int y = std::max(first_centre(low, band.top + band.height), band.top); y < end; ++y) {
    const double centre = y + 0.5;
    crossing.clear();
    Vec2 a = outline.back();
    for (const Vec2& b : outline) {
      if ((a.y() <= centre) != (b.y() <= centre))
        crossing.push_back(a.x() + (centre - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      a = b;
    }
    std::sort(crossing.begin(), crossing.end());
    std::uint16_t* row = band.row(y);
    for (std::size_t k = 0; k + 1 < crossing.size(); k += 2)
      std::fill(row + first_centre(crossing[k], band.width), row + first_centre(crossing[k + 1], band.width),
                value);
  }
}

// Flags the samples within half a width of the line, measured along the axis that it runs across.
void flag_line(Band& band, const Vec2& a, const Vec2& b, double width) {
  const Vec2 d = b - a;
  const double length = d.norm();
  if (!(length > 0.0)) return;
  const int bottom = band.top + band.height;
  const auto clamped = [](double x, int low, int high) {
    return static_cast<int>(
        std::clamp(std::ceil(x - 0.5), static_cast<double>(low), static_cast<double>(high)));
  };
  if (std::abs(d.x()) >= std::abs(d.y())) {
    const double half = 0.5 * width * length / std::abs(d.x());
    const int end = clamped(std::max(a.x(), b.x()), 0, band.width);
    for (int x = clamped(std::min(a.x(), b.x()), 0, band.width); x < end; ++x) {
      const double y = a.y() + (x + 0.5 - a.x()) / d.x() * d.y();
      for (int k = clamped(y - half, band.top, bottom); k < clamped(y + half, band.top, bottom); ++k)
        band.row(k)[x] |= edge_flag;
    }
    return;
  }
  const double half = 0.5 * width * length / std::abs(d.y());
  const int end = clamped(std::max(a.y(), b.y()), band.top, bottom);
  for (int y = clamped(std::min(a.y(), b.y()), band.top, bottom); y < end; ++y) {
    const double x = a.x() + (y + 0.5 - a.y()) / d.y() * d.x();
    std::uint16_t* row = band.row(y);
    for (int k = clamped(x - half, 0, band.width); k < clamped(x + half, 0, band.width); ++k)
      row[k] |= edge_flag;
  }
}

// Cells as outlines in samples, with the bands they reach into.
struct Shapes {
  std::vector<Outline> outline; ///< [cell], empty for cells that are not seen
  std::vector<std::vector<std::size_t>> of_band;
};

Shapes place_shapes(const PixelArea& area, const CellGeometry<2>& cells, const std::vector<Vec2>& pixel,
                    double margin) {
  Shapes shapes;
  shapes.outline.resize(cells.begin.size() - 1);
  shapes.of_band.resize(static_cast<std::size_t>((area.height + band_height - 1) / band_height));
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    const auto begin = static_cast<std::size_t>(cells.begin[c]),
               end = static_cast<std::size_t>(cells.begin[c + 1]);
    if (begin == end) continue;
    Vec2 low = pixel[static_cast<std::size_t>(cells.index[begin])], high = low;
    bool finite = true;
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2& p = pixel[static_cast<std::size_t>(cells.index[k])];
      finite = finite && p.allFinite();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if (!finite || high.x() < -margin || high.y() < -margin || low.x() > area.width + margin ||
        low.y() > area.height + margin)
      continue;
    for (std::size_t k = begin; k < end; ++k)
      shapes.outline[c].push_back(pixel[static_cast<std::size_t>(cells.index[k])] * oversampling);
    const double last = static_cast<double>(shapes.of_band.size()) - 1.0;
    const auto band_of = [&](double y) {
      return static_cast<std::size_t>(std::clamp(std::floor(y / band_height), 0.0, last));
    };
    for (std::size_t b = band_of(low.y() - margin); b <= band_of(high.y() + margin); ++b)
      shapes.of_band[b].push_back(c);
  }
  return shapes;
}

/// Mean colour of the cells in a pixel, and how many of its samples they cover.
struct Layer {
  std::vector<std::uint32_t> colour; ///< [y · width + x]
  std::vector<std::uint8_t> covered;
};

void average(Band& band, const SampleColours& colours, int width, int first_row, Layer& layer) {
  for (int y = 0; y < band.height / oversampling; ++y) {
    std::array<const std::uint16_t*, oversampling> row{};
    for (int j = 0; j < oversampling; ++j)
      row[static_cast<std::size_t>(j)] = band.row(band.top + y * oversampling + j);
    const std::size_t to = static_cast<std::size_t>(first_row + y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width; ++x) {
      const std::uint16_t first = row[0][x * oversampling];
      bool same = true;
      for (const std::uint16_t* r : row)
        for (int i = 0; i < oversampling; ++i) same = same && r[x * oversampling + i] == first;
      const std::size_t at = to + static_cast<std::size_t>(x);
      if (same) {
        if (first & painted) {
          layer.colour[at] = packed(colours[first & (level_mask | edge_flag)]);
          layer.covered[at] = samples;
        }
        continue;
      }
      int count = 0;
      Rgb sum;
      for (const std::uint16_t* r : row)
        for (int i = 0; i < oversampling; ++i) {
          const std::uint16_t s = r[x * oversampling + i];
          if (!(s & painted)) continue;
          const Rgb& c = colours[s & (level_mask | edge_flag)];
          ++count;
          sum.red += c.red;
          sum.green += c.green;
          sum.blue += c.blue;
        }
      if (count == 0) continue;
      const auto mean = [&](int c) { return (c + count / 2) / count; };
      layer.colour[at] = packed({mean(sum.red), mean(sum.green), mean(sum.blue)});
      layer.covered[at] = static_cast<std::uint8_t>(count);
    }
  }
}

Rgb over(const Rgb& above, double alpha, const Rgb& below) {
  const auto mix = [&](int a, int b) { return static_cast<int>(std::lround(alpha * a + (1.0 - alpha) * b)); };
  return {mix(above.red, below.red), mix(above.green, below.green), mix(above.blue, below.blue)};
}

// The rim is the silhouette in dark, shifted a little to each side, beneath the cells.
void compose(const PixelArea& area, const Layer& layer, double rim) {
  const Rgb dark = rgb_of(rim_colour);
  const int near = static_cast<int>(rim);
  const double beyond = rim - near;
  const auto width = static_cast<std::size_t>(area.width);
  const auto covered = [&](int x, int y) {
    return x < 0 || y < 0 || x >= area.width || y >= area.height
               ? 0
               : layer.covered[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
      std::uint32_t& pixel =
          area.first[static_cast<std::size_t>(y) * area.stride + static_cast<std::size_t>(x)];
      if (layer.covered[at] == samples) {
        pixel = layer.colour[at];
        continue;
      }
      double light = 1.0; // that no shifted silhouette takes away
      for (const auto& [i, j] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
        light *= 1.0 - ((1.0 - beyond) * covered(x + near * i, y + near * j) +
                        beyond * covered(x + (near + 1) * i, y + (near + 1) * j)) /
                           samples;
      if (light == 1.0 && layer.covered[at] == 0) continue;
      const Rgb below = over(dark, 1.0 - light, unpacked(pixel));
      pixel =
          packed(over(unpacked(layer.colour[at]), layer.covered[at] / static_cast<double>(samples), below));
    }
}

} // namespace

void paint_cells(const PixelArea& area, const CellGeometry<2>& cells, const std::vector<Vec2>& pixel,
                 const CellPaint& paint) {
  if (cells.begin.empty()) return;
  const double edge = oversampling * paint.edge;
  const Shapes shapes = place_shapes(area, cells, pixel, 1.0 + paint.edge);
  const SampleColours colours = sample_colours(paint);
  const std::size_t pixels = static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height);
  Layer layer{std::vector<std::uint32_t>(pixels), std::vector<std::uint8_t>(pixels)};
  Band band;
  band.width = oversampling * area.width;
  std::vector<double> crossing;
  for (std::size_t b = 0; b < shapes.of_band.size(); ++b) {
    const int first = static_cast<int>(b) * band_height;
    band.top = oversampling * first;
    band.height = oversampling * std::min(band_height, area.height - first);
    band.sample.assign(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height), 0);
    for (const std::size_t c : shapes.of_band[b])
      fill(band, shapes.outline[c], static_cast<std::uint16_t>(painted | level_of(paint, c)), crossing);
    if (edge > 0.0)
      for (const std::size_t c : shapes.of_band[b]) {
        Vec2 a = shapes.outline[c].back();
        for (const Vec2& p : shapes.outline[c]) {
          flag_line(band, a, p, edge);
          a = p;
        }
      }
    average(band, colours, area.width, first, layer);
  }
  compose(area, layer, paint.rim);
}

} // namespace cnem::io
