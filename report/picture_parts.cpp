#include "report/picture_parts.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "report/palette_png.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem::report {
namespace {

void select_font(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
}

// What can be seen of the plot, with a margin for the width of lines.
struct View {
  Vec2 low, high;

  explicit View(const PictureLayout& layout)
      : low(layout.plot_left - 4, layout.plot_top - 4),
        high(layout.plot_left + layout.plot_width + 4, layout.plot_top + layout.plot_height + 4) {}
  bool holds(const Vec2& least, const Vec2& most) const {
    return (least.array() <= high.array()).all() && (most.array() >= low.array()).all() &&
           (most - least).maxCoeff() < 1e5; // cairo works in 24.8 fixed point
  }
};

void fill_cells(cairo_t* cr, const View& view, const std::vector<Vec2>& pixel, const Picture& picture,
                const ColourRange& range) {
  const CellGeometry<2>& cells = *picture.cells;
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    const auto begin = index_of(cells.begin[c]), end = index_of(cells.begin[c + 1]);
    if (begin == end) continue;
    Vec2 low = pixel[index_of(cells.index[begin])], high = low;
    bool finite = true;
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2& p = pixel[index_of(cells.index[k])];
      finite = finite && p.allFinite();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    if (!finite || !view.holds(low, high)) continue;
    cairo_new_path(cr);
    for (std::size_t k = begin; k < end; ++k) {
      const Vec2& p = pixel[index_of(cells.index[k])];
      cairo_line_to(cr, p.x(), p.y());
    }
    cairo_close_path(cr);
    const double s = (picture.value[c] - range.low) / (range.high - range.low), last = drawing_levels - 1;
    const Colour colour = map_colour(picture.map, std::round(s * last) / last);
    cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
    cairo_fill(cr);
  }
}

// Edges of cells as pairs of vertices: those between two cells, and those at the rim of the body.
struct CellEdges {
  std::vector<std::array<std::int32_t, 2>> inner, rim;
};

CellEdges edges_of(const CellGeometry<2>& cells) {
  std::vector<std::int32_t> begin(cells.vertex.size() + 1, 0);
  const auto for_edges = [&](auto&& use) {
    for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c)
      for (auto b = cells.begin[c], e = cells.begin[c + 1], k = b; k < e; ++k)
        use(cells.index[index_of(k)], cells.index[index_of(k + 1 < e ? k + 1 : b)]);
  };
  for_edges([&](std::int32_t from, std::int32_t) { ++begin[index_of(from) + 1]; });
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) begin[v + 1] += begin[v];
  std::vector<std::int32_t> end(begin.begin(), begin.end() - 1), next(cells.index.size());
  for_edges([&](std::int32_t from, std::int32_t to) { next[index_of(end[index_of(from)]++)] = to; });
  CellEdges edges;
  for_edges([&](std::int32_t from, std::int32_t to) {
    const auto back = next.begin() + begin[index_of(to)], last = next.begin() + end[index_of(to)];
    if (std::find(back, last, from) == last)
      edges.rim.push_back({from, to});
    else if (from < to)
      edges.inner.push_back({from, to});
  });
  return edges;
}

void stroke_edges(cairo_t* cr, const View& view, const std::vector<Vec2>& pixel,
                  const std::vector<std::array<std::int32_t, 2>>& edges) {
  constexpr int most = 300; // cairo takes more than twice the time for all edges in one path
  int count = 0;
  cairo_new_path(cr);
  for (const auto& [from, to] : edges) {
    const Vec2 &a = pixel[index_of(from)], &b = pixel[index_of(to)];
    if (!a.allFinite() || !b.allFinite() || !view.holds(a.cwiseMin(b), a.cwiseMax(b))) continue;
    cairo_move_to(cr, a.x(), a.y());
    cairo_line_to(cr, b.x(), b.y());
    if (++count % most == 0) cairo_stroke(cr);
  }
  cairo_stroke(cr);
}

} // namespace

Surface make_surface(cairo_format_t format, int width, int height) {
  Surface surface(cairo_image_surface_create(format, width, height));
  if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
    throw IoError(
        fmt::format("cannot draw a picture of {} x {}: {}", width, height, cairo_status_to_string(status)));
  return surface;
}

Context make_context(const Surface& surface) { return Context(cairo_create(surface.get())); }

double text_width(cairo_t* cr, const std::string& text, double size, bool bold) {
  select_font(cr, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size, bool bold) {
  select_font(cr, size, bold);
  cairo_move_to(cr, x, y);
  cairo_show_text(cr, text.c_str());
  cairo_new_path(cr); // showing text leaves a current point behind
}

void paint_cells(cairo_t* cr, const PictureLayout& layout, const Picture& picture,
                 const std::vector<Vec2>& vertices, const ColourRange& range, double line) {
  std::vector<Vec2> pixel(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) pixel[v] = layout.pixel(vertices[v]);
  const View view(layout);
  const CellEdges edges = edges_of(*picture.cells);
  // Without antialiasing neighbouring cells meet without seams, and are filled in a fraction of the time.
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  fill_cells(cr, view, pixel, picture, range);
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_FAST);
  if (line > 0.0) {
    cairo_set_source_rgba(cr, 0.0, 0.0, 0.0, cell_line_shade);
    cairo_set_line_width(cr, line);
    stroke_edges(cr, view, pixel, edges.inner);
  }
  cairo_set_source_rgb(cr, 0.12, 0.13, 0.16);
  cairo_set_line_width(cr, layout.width / 700.0);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  stroke_edges(cr, view, pixel, edges.rim);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
}

void draw_colour_bar(cairo_t* cr, const PictureLayout& layout, const Picture& picture,
                     const ColourRange& range, double unit, double size) {
  const double width = 30.0 * unit, x = layout.plot_left + layout.plot_width + 26.0 * unit;
  const double tip = 16.0 * unit; // the bar ends in a point where values lie beyond it
  bool below = false, above = false, invalid = false;
  const double slack = 1e-9 * (range.high - range.low);
  for (const double v : picture.value) {
    below = below || v < range.low - slack;
    above = above || v > range.high + slack;
    invalid = invalid || std::isnan(v);
  }
  const double top = layout.plot_top + (picture.unit.empty() ? 0.0 : 1.2 * size) + tip;
  const double bottom = layout.plot_top + layout.plot_height - tip;
  const auto y_of = [&](double s) { return bottom + s * (top - bottom); };

  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  constexpr int strips = 256;
  for (int k = 0; k < strips; ++k) {
    const Colour colour = map_colour(picture.map, (k + 0.5) / strips);
    cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
    cairo_rectangle(cr, x, y_of((k + 1.0) / strips), width,
                    y_of(k / double{strips}) - y_of((k + 1.0) / strips));
    cairo_fill(cr);
  }
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
  const auto point = [&](double s, double y, double end) {
    const Colour colour = map_colour(picture.map, s);
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x + 0.5 * width, end);
    cairo_line_to(cr, x + width, y);
    cairo_close_path(cr);
    cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
    cairo_fill(cr);
  };
  if (above) point(1.0, top, top - tip);
  if (below) point(0.0, bottom, bottom + tip);

  const double f = picture.unit_factor;
  const results::Ticks ticks = results::round_ticks(range.low / f, range.high / f, 6);
  cairo_set_source_rgb(cr, 0.16, 0.18, 0.22);
  cairo_set_line_width(cr, 1.5 * unit);
  for (std::size_t k = 0; k < ticks.value.size(); ++k) {
    const double y = y_of((ticks.value[k] * f - range.low) / (range.high - range.low));
    cairo_move_to(cr, x + width, y);
    cairo_line_to(cr, x + width + 7.0 * unit, y);
    cairo_stroke(cr);
    draw_text(cr, ticks.label[k], x + width + 13.0 * unit, y + 0.36 * size, size);
  }
  if (!picture.unit.empty()) draw_text(cr, picture.unit, x, layout.plot_top + 0.75 * size, size);
  if (invalid) {
    cairo_set_source_rgb(cr, invalid_colour.red, 0.0, invalid_colour.blue);
    draw_text(cr, "not a number", x, layout.plot_top + layout.plot_height + 1.4 * size, 0.75 * size);
  }
}

void draw_scale_bar(cairo_t* cr, const PictureLayout& layout, double unit, double size) {
  const double longest = 0.28 * layout.plot_width / layout.scale; // m
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  const double length = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
  const double x = layout.plot_left + 2 * unit, y = layout.plot_top + layout.plot_height + 1.15 * size;
  const double end = x + length * layout.scale, half = 7.0 * unit;
  cairo_set_source_rgb(cr, 0.09, 0.11, 0.15);
  cairo_set_line_width(cr, 3.0 * unit);
  cairo_move_to(cr, x, y);
  cairo_line_to(cr, end, y);
  for (const double at : {x, end}) {
    cairo_move_to(cr, at, y - half);
    cairo_line_to(cr, at, y + half);
  }
  cairo_stroke(cr);
  draw_text(cr, results::si_format(length, "m", 3), end + 0.5 * size, y + 0.36 * size, size);
}

void draw_extremes(cairo_t* cr, const PictureLayout& layout, const Picture& picture, double size) {
  double low = 0.0, high = 0.0;
  bool any = false;
  for (const double v : picture.value) {
    if (!std::isfinite(v)) continue;
    low = any ? std::min(low, v) : v;
    high = any ? std::max(high, v) : v;
    any = true;
  }
  if (!any) return;
  if (std::abs(low) < 1e-9 * std::abs(high)) low = 0.0;
  if (std::abs(high) < 1e-9 * std::abs(low)) high = 0.0;
  const double f = picture.unit_factor;
  const std::string suffix = picture.unit.empty() ? "" : " " + picture.unit;
  const std::string text = fmt::format("min {}{}   max {}{}", results::number_format(low / f, 4), suffix,
                                       results::number_format(high / f, 4), suffix);
  cairo_set_source_rgb(cr, 0.42, 0.46, 0.53);
  draw_text(cr, text, layout.plot_left + layout.plot_width - text_width(cr, text, 0.9 * size),
            layout.plot_top + layout.plot_height + 1.5 * size, 0.9 * size);
}

} // namespace cnem::report
