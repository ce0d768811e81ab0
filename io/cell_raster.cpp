#include "io/cell_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

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
  std::vector<std::uint16_t> sample;  ///< and one more

  std::uint16_t* row(int y) {
    return sample.data() + static_cast<std::size_t>(y - top) * static_cast<std::size_t>(width);
  }
};

// In samples; the outline is closed.
using Outline = std::vector<Vec2>;

// Number of samples whose centre lies below x, from 0 to `limit`.
int centres_below(double x, int limit) {
  return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(limit)) + 0.5);
}

bool convex(const Outline& outline) {
  bool left = false, right = false;
  for (std::size_t k = 0, n = outline.size(); k < n; ++k) {
    const Vec2 &a = outline[k], &b = outline[(k + 1) % n], &c = outline[(k + 2) % n];
    const double turn = cross(b - a, c - b);
    left = left || turn > 0.0;
    right = right || turn < 0.0;
  }
  return !(left && right);
}

// Fills outlines; what it needs for one is kept for the next.
class Filler {
public:
  void fill(Band& band, const Outline& outline, std::uint16_t value) {
    double low = outline.front().y(), high = low;
    for (const Vec2& p : outline) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
    const int limit = band.top + band.height;
    const int begin = std::max(centres_below(low, limit), band.top), end = centres_below(high, limit);
    if (begin >= end) return;
    if (convex(outline))
      fill_convex(band, outline, value, begin, end);
    else
      fill_any(band, outline, value, begin, end);
  }

private:
  void fill_convex(Band& band, const Outline& outline, std::uint16_t value, int begin, int end) {
    const auto rows = static_cast<std::size_t>(end - begin);
    first_.assign(rows, std::numeric_limits<double>::infinity());
    last_.assign(rows, -std::numeric_limits<double>::infinity());
    Vec2 a = outline.back();
    for (const Vec2& b : outline) {
      const int from = std::max(centres_below(std::min(a.y(), b.y()), end), begin);
      const int to = centres_below(std::max(a.y(), b.y()), end);
      const double slope = from < to ? (b.x() - a.x()) / (b.y() - a.y()) : 0.0;
      for (int y = from; y < to; ++y) {
        const double x = a.x() + (y + 0.5 - a.y()) * slope;
        const auto k = static_cast<std::size_t>(y - begin);
        first_[k] = std::min(first_[k], x);
        last_[k] = std::max(last_[k], x);
      }
      a = b;
    }
    for (std::size_t k = 0; k < rows; ++k)
      span(band, begin + static_cast<int>(k), first_[k], last_[k], value);
  }

  void fill_any(Band& band, const Outline& outline, std::uint16_t value, int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const double centre = y + 0.5;
      first_.clear(); // crossings
      Vec2 a = outline.back();
      for (const Vec2& b : outline) {
        if ((a.y() <= centre) != (b.y() <= centre))
          first_.push_back(a.x() + (centre - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        a = b;
      }
      std::sort(first_.begin(), first_.end());
      for (std::size_t k = 0; k + 1 < first_.size(); k += 2) span(band, y, first_[k], first_[k + 1], value);
    }
  }

  static void span(Band& band, int y, double from, double to, std::uint16_t value) {
    const int begin = centres_below(from, band.width), end = centres_below(to, band.width);
    if (begin < end) std::fill(band.row(y) + begin, band.row(y) + end, value);
  }

  std::vector<double> first_, last_;
};

// Flags the samples within half a width of the line, measured along the axis that it runs across.
void flag_line(Band& band, const Vec2& a, const Vec2& b, double width) {
  const Vec2 d = b - a;
  const double length = d.norm();
  if (!(length > 0.0)) return;
  const int bottom = band.top + band.height;
  if (std::abs(d.x()) >= std::abs(d.y())) {
    const double half = 0.5 * width * length / std::abs(d.x()), slope = d.y() / d.x();
    const int end = centres_below(std::max(a.x(), b.x()), band.width);
    for (int x = centres_below(std::min(a.x(), b.x()), band.width); x < end; ++x) {
      const double y = a.y() + (x + 0.5 - a.x()) * slope;
      const int last = centres_below(y + half, bottom);
      for (int k = std::max(centres_below(y - half, bottom), band.top); k < last; ++k)
        band.row(k)[x] |= edge_flag;
    }
    return;
  }
  const double half = 0.5 * width * length / std::abs(d.y()), slope = d.x() / d.y();
  const int end = centres_below(std::max(a.y(), b.y()), bottom);
  for (int y = std::max(centres_below(std::min(a.y(), b.y()), bottom), band.top); y < end; ++y) {
    const double x = a.x() + (y + 0.5 - a.y()) * slope;
    std::uint16_t* row = band.row(y);
    const int last = centres_below(x + half, band.width);
    for (int k = centres_below(x - half, band.width); k < last; ++k) row[k] |= edge_flag;
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

// Edges (by their first vertex in cells.index) that another cell has the other way round: drawing one of the
// two will do.
std::vector<bool> repeated_edges(const CellGeometry<2>& cells, std::size_t vertices) {
  constexpr std::size_t most = 4; // rarely does a vertex have more; their edges are drawn twice
  std::vector<std::array<std::int32_t, most>> upward(vertices, {-1, -1, -1, -1});
  std::vector<bool> repeated(cells.index.size());
  for (const bool look : {false, true})
    for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
      const auto begin = static_cast<std::size_t>(cells.begin[c]),
                 end = static_cast<std::size_t>(cells.begin[c + 1]);
      for (std::size_t k = begin; k < end; ++k) {
        const std::int32_t from = cells.index[k], to = cells.index[k + 1 < end ? k + 1 : begin];
        auto& known = upward[static_cast<std::size_t>(std::min(from, to))];
        if (!look && from < to) *std::min_element(known.begin(), known.end()) = to;
        if (look && from > to) repeated[k] = std::find(known.begin(), known.end(), from) != known.end();
      }
    }
  return repeated;
}

/// Mean colour of the cells in a pixel, and how many of its samples they cover, with a margin all round.
struct Layer {
  int margin = 0;
  std::size_t stride = 0; ///< pixels
  std::vector<std::uint32_t> colour;
  std::vector<std::uint8_t> covered;

  Layer(int width, int height, int margin_)
      : margin(margin_), stride(static_cast<std::size_t>(width + 2 * margin_)),
        colour(stride * static_cast<std::size_t>(height + 2 * margin_)), covered(colour.size()) {}
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y + margin) * stride + static_cast<std::size_t>(x + margin);
  }
};

// Three samples side by side as one number. Reads a fourth.
std::uint64_t triple(const std::uint16_t* sample) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, sample, sizeof bits);
  return bits & 0xFFFFFFFFFFFF;
}

void average(Band& band, const SampleColours& colours, int width, int first_row, Layer& layer) {
  for (int y = 0; y < band.height / oversampling; ++y) {
    const std::uint16_t* row[oversampling];
    for (int j = 0; j < oversampling; ++j) row[j] = band.row(band.top + y * oversampling + j);
    std::size_t at = layer.at(0, first_row + y);
    for (int x = 0; x < width; ++x, ++at) {
      const std::uint16_t first = row[0][x * oversampling];
      const std::uint64_t same = first * std::uint64_t{0x100010001};
      bool equal = true;
      for (const std::uint16_t* r : row) equal = equal && triple(r + x * oversampling) == same;
      if (equal) {
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
  const auto stride = static_cast<std::ptrdiff_t>(layer.stride);
  for (int y = 0; y < area.height; ++y) {
    std::uint32_t* row = area.first + static_cast<std::size_t>(y) * area.stride;
    for (int x = 0; x < area.width; ++x) {
      const std::size_t at = layer.at(x, y);
      const std::uint8_t* covered = layer.covered.data() + at;
      if (*covered == samples) {
        row[x] = layer.colour[at];
        continue;
      }
      bool any = *covered > 0;
      for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, -std::ptrdiff_t{1}, stride, -stride})
        any = any || covered[near * step] > 0 || covered[(near + 1) * step] > 0;
      if (!any) continue;
      double light = 1.0; // that no shifted silhouette takes away
      for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, -std::ptrdiff_t{1}, stride, -stride})
        light *=
            1.0 - ((1.0 - beyond) * covered[near * step] + beyond * covered[(near + 1) * step]) / samples;
      const Rgb below = over(dark, 1.0 - light, unpacked(row[x]));
      row[x] = packed(over(unpacked(layer.colour[at]), *covered / static_cast<double>(samples), below));
    }
  }
}

} // namespace

void paint_cells(const PixelArea& area, const CellGeometry<2>& cells, const std::vector<Vec2>& pixel,
                 const CellPaint& paint) {
  if (cells.begin.empty()) return;
  const double edge = oversampling * paint.edge;
  const Shapes shapes = place_shapes(area, cells, pixel, 1.0 + paint.edge);
  const std::vector<bool> twice = edge > 0.0 ? repeated_edges(cells, pixel.size()) : std::vector<bool>();
  const SampleColours colours = sample_colours(paint);
  Layer layer(area.width, area.height, static_cast<int>(paint.rim) + 1);
  Band band;
  band.width = oversampling * area.width;
  Filler filler;
  for (std::size_t b = 0; b < shapes.of_band.size(); ++b) {
    const int first = static_cast<int>(b) * band_height;
    band.top = oversampling * first;
    band.height = oversampling * std::min(band_height, area.height - first);
    band.sample.assign(static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height) + 1, 0);
    for (const std::size_t c : shapes.of_band[b])
      filler.fill(band, shapes.outline[c], static_cast<std::uint16_t>(painted | level_of(paint, c)));
    if (edge > 0.0)
      for (const std::size_t c : shapes.of_band[b]) {
        const Outline& outline = shapes.outline[c];
        for (std::size_t k = 0; k < outline.size(); ++k)
          if (!twice[static_cast<std::size_t>(cells.begin[c]) + k])
            flag_line(band, outline[k], outline[k + 1 < outline.size() ? k + 1 : 0], edge);
      }
    average(band, colours, area.width, first, layer);
  }
  compose(area, layer, paint.rim);
}

} // namespace cnem::io
