#include "report/picture_parts.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "report/cell_raster.hpp"
#include "report/palette_png.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cnem::report {
namespace {

/// One of the levels of a drawing.
Colour drawn_colour(ColourMap map, double value, const ColourRange& range, int levels = drawing_levels) {
  const double s = (value - range.low) / (range.high - range.low), last = levels - 1;
  return map_colour(map, std::round(s * last) / last);
}

/// Of a surface under light.
Colour lit_colour(const Picture& picture, std::size_t cell, const ColourRange& range) {
  Colour colour = drawn_colour(picture.map, picture.value[cell], range, lit_levels);
  for (double* c : {&colour.red, &colour.green, &colour.blue})
    *c *= 1.0 - most_darkness * static_cast<double>(picture.darkness[cell]);
  return colour;
}

void select_font(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
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

void draw_rimmed_text(cairo_t* cr, const std::string& text, double x, double y, double size) {
  select_font(cr, size, false);
  cairo_move_to(cr, x, y);
  cairo_text_path(cr, text.c_str());
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgb(cr, 0.8, 0.8, 0.8);
  cairo_set_line_width(cr, 0.2 * size);
  cairo_stroke_preserve(cr);
  cairo_set_source_rgb(cr, 0.23, 0.23, 0.23);
  cairo_fill(cr);
}

void paint_tools(cairo_t* cr, const PictureLayout& layout, const Picture& picture, const ColourRange& range) {
  if (!picture.warm_tools) return;
  const CellGeometry<2>& cells = picture.warm_tools->cells;
  const std::span<const double> value = picture.warm_tools->values.front();
  const std::vector<Vec2>& vertices = cells.vertex;
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  for (std::size_t c = 0; c < value.size(); ++c) {
    for (auto e = index_of(cells.begin[c]); e < index_of(cells.begin[c + 1]); ++e) {
      const Vec2 x = layout.pixel(vertices[index_of(cells.index[e])]);
      cairo_line_to(cr, x.x(), x.y());
    }
    cairo_close_path(cr);
    const Colour colour = drawn_colour(picture.map, value[c], range);
    cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
    cairo_fill(cr);
  }
  cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
}

namespace {

/// A colour over a pixel of which it covers a part, of 255.
std::uint32_t covered(std::uint32_t pixel, std::uint32_t colour, std::uint32_t part) {
  std::uint32_t result = 0;
  for (const int shift : {16, 8, 0})
    result |= (((pixel >> shift & 0xFFU) * (255U - part) + (colour >> shift & 0xFFU) * part + 127U) / 255U)
              << shift;
  return result;
}

} // namespace

void paint_cells(const Surface& surface, const Picture& picture, const CellRaster& raster,
                 const ColourRange& range) {
  std::vector<std::uint32_t> colour(picture.value.size());
  for (std::size_t c = 0; c < colour.size(); ++c)
    colour[c] = packed(picture.darkness.empty() ? drawn_colour(picture.map, picture.value[c], range)
                                                : lit_colour(picture, c, range));
  if (picture.solids)
    for (const float darkness : picture.solids->darkness) {
      const double grey = 0.86 * (1.0 - most_darkness * static_cast<double>(darkness));
      colour.push_back(packed({grey, grey, grey}));
    }
  const std::uint32_t rim = packed({0.13, 0.13, 0.13});
  cairo_surface_flush(surface.get());
  const int width = cairo_image_surface_get_width(surface.get()),
            height = cairo_image_surface_get_height(surface.get());
  std::size_t k = 0;
  for (int y = 0; y < height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface.get()) +
                                                 y * cairo_image_surface_get_stride(surface.get()));
    for (int x = 0; x < width; ++x, ++k) {
      if (raster.cell[k] >= 0) row[x] = colour[index_of(raster.cell[k])];
      if (!raster.lines.empty() && raster.lines[k] > 0)
        row[x] =
            covered(row[x], 0, static_cast<std::uint32_t>(std::lround(cell_line_shade * raster.lines[k])));
      if (raster.rim[k] > 0) row[x] = covered(row[x], rim, raster.rim[k]);
    }
  }
  cairo_surface_mark_dirty(surface.get());
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
  const double top = std::round(layout.plot_top + (picture.unit.unit.empty() ? 0.0 : 1.2 * size) + tip);
  const double bottom = std::round(layout.plot_top + layout.plot_height - tip);
  const auto y_of = [&](double s) { return bottom + s * (top - bottom); };

  cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
  constexpr int strips = 256;
  for (int k = 0; k < strips; ++k) {
    const Colour colour = map_colour(picture.map, (k + 0.5) / strips);
    cairo_set_source_rgb(cr, colour.red, colour.green, colour.blue);
    const double upper = std::floor(y_of((k + 1.0) / strips)); // over a part of the strip below: no seams
    cairo_rectangle(cr, x, upper, width, std::ceil(y_of(k / double{strips})) - upper);
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

  const results::DisplayUnit& shown = picture.unit;
  int wanted = std::clamp(static_cast<int>((bottom - top) / (3.0 * size)), 2, 6);
  const double low = shown.shown(range.low), high = shown.shown(range.high);
  results::Ticks ticks = results::round_ticks(low, high, wanted);
  while (ticks.value.size() < 2 && wanted < 12) // fewer than wanted fit about a zero in the middle
    ticks = results::round_ticks(low, high, ++wanted);
  const double at = x + width + 13.0 * unit, room = layout.width - at;
  double label_size = size; // long ones are smaller
  for (const std::string& label : ticks.label)
    label_size = std::min(label_size, size * room / text_width(cr, label, size));
  cairo_set_source_rgb(cr, 0.18, 0.18, 0.18);
  cairo_set_line_width(cr, 1.5 * unit);
  for (std::size_t k = 0; k < ticks.value.size(); ++k) {
    const double y = y_of((ticks.value[k] - low) / (high - low));
    cairo_move_to(cr, x + width, y);
    cairo_line_to(cr, x + width + 7.0 * unit, y);
    cairo_stroke(cr);
    draw_text(cr, ticks.label[k], at, y + 0.36 * label_size, label_size);
  }
  if (!shown.unit.empty()) draw_text(cr, shown.unit, x, layout.plot_top + 0.75 * size, size);
  if (invalid) {
    cairo_set_source_rgb(cr, invalid_colour.red, 0.0, invalid_colour.blue);
    draw_text(cr, "not a number", x, layout.plot_top + layout.plot_height + 1.4 * size, 0.75 * size);
  }
}

void draw_scale_bar(cairo_t* cr, const PictureLayout& layout, double unit, double size) {
  const double longest = 0.2 * layout.plot_width / layout.scale; // m
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  const double length = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
  const double x = layout.plot_left + 2 * unit, y = layout.plot_top + layout.plot_height + 1.15 * size;
  const double end = x + length * layout.scale, half = 7.0 * unit;
  cairo_set_source_rgb(cr, 0.11, 0.11, 0.11);
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

void draw_extremes(cairo_t* cr, const PictureLayout& layout, const Picture& picture,
                   const std::string& statement, double size) {
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
  const std::string text = fmt::format("min {}   max {}", results::format_in(picture.unit, low),
                                       results::format_in(picture.unit, high));
  cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
  double y = layout.plot_top + layout.plot_height + 1.5 * size;
  for (const std::string& line : {text, statement}) {
    draw_text(cr, line, layout.plot_left + layout.plot_width - text_width(cr, line, 0.9 * size), y,
              0.9 * size);
    y += 1.2 * size;
  }
}

} // namespace cnem::report
