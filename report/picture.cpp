#include "report/picture.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "report/cell_raster.hpp"
#include "report/picture_parts.hpp"
#include "results/si_format.hpp"
#include "results/vtk_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cnem::report {
namespace {

// Sizes in px of a picture 1400 px wide; everything scales with the width.
constexpr double design_width = 1400.0, title_height = 88.0, footer_height = 84.0, bar_space = 236.0,
                 left_margin = 20.0, font = 38.0; // read on a phone, a quarter as wide

void check(const Picture& picture) {
  if (!picture.cells) throw InputError("picture: no cells");
  const std::size_t cells = picture.cells->begin.empty() ? 0 : picture.cells->begin.size() - 1;
  if (picture.value.size() != cells)
    throw InputError(
        fmt::format("picture of {}: {} values for {} cells", picture.label, picture.value.size(), cells));
  if (!picture.darkness.empty() && picture.darkness.size() != cells)
    throw InputError(fmt::format("picture of {}: {} darknesses for {} cells", picture.label,
                                 picture.darkness.size(), cells));
  if (!picture.depth.empty() && picture.depth.size() != picture.cells->vertex.size())
    throw InputError(fmt::format("picture of {}: {} depths for {} vertices", picture.label,
                                 picture.depth.size(), picture.cells->vertex.size()));
  if (picture.width < 200) throw InputError("picture: the width must be at least 200 px");
}

struct Bounds {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& x) {
    if (!x.allFinite()) return; // a run that diverged is worth a picture too
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
};

// The body with a narrow margin, a wider one where a tool stands.
PictureWindow body_window(const Picture& picture, const std::vector<Vec2>& vertices) {
  Bounds body;
  for (const Vec2& x : vertices) body.add(x);
  if (!(body.low.x() <= body.high.x())) return {Vec2(0, 0), Vec2(1, 1)};
  const double size = std::max((body.high - body.low).maxCoeff(), 1e-12);
  PictureWindow window{body.low.array() - 0.025 * size, body.high.array() + 0.025 * size};
  Bounds tools;
  for (const PictureTool& tool : picture.tools)
    for (const CurvePiece& piece : tool.curve->pieces)
      for (const double s : {0.0, 0.25, 0.5, 0.75}) tools.add(piece.point(s) + tool.displacement);
  if (picture.solids)
    for (const auto& face : picture.solids->corner)
      for (const Vec3& x : face) tools.add(x.head<2>());
  for (int k = 0; k < 2; ++k) {
    window.low[k] = std::max(std::min(window.low[k], tools.low[k] - 0.025 * size), body.low[k] - 0.12 * size);
    window.high[k] =
        std::min(std::max(window.high[k], tools.high[k] + 0.025 * size), body.high[k] + 0.12 * size);
  }
  return window;
}

// Whatever is stated below the footer's line.
std::string statement(const Picture& picture) {
  return picture.percentile ? fmt::format("colours span at least {:g}% of the {}", *picture.percentile,
                                          picture.map == ColourMap::diverging ? "magnitudes" : "cells")
                            : "";
}

PictureLayout layout_of(const Picture& picture, const std::vector<Vec2>& vertices) {
  PictureWindow window = picture.window ? *picture.window : body_window(picture, vertices);
  if (!((window.high - window.low).minCoeff() > 0.0))
    throw InputError("picture: the window must have a positive width and height");
  const double unit = picture.width / design_width;
  PictureLayout layout;
  layout.width = picture.width;
  layout.plot_left = std::round(left_margin * unit);
  layout.plot_top = std::round(title_height * unit);
  layout.plot_width = std::round(picture.width - (left_margin + bar_space) * unit);
  // Neither a strip nor a tower: the window grows in the other direction.
  const double aspect = (window.high.y() - window.low.y()) / (window.high.x() - window.low.x());
  layout.plot_height = std::round(layout.plot_width * std::clamp(aspect, 0.3, 1.0));
  layout.scale = std::min(layout.plot_width / (window.high.x() - window.low.x()),
                          layout.plot_height / (window.high.y() - window.low.y()));
  const double footer = footer_height + (statement(picture).empty() ? 0.0 : 1.2 * font);
  layout.height = static_cast<int>(std::round(layout.plot_top + layout.plot_height + footer * unit));
  const Vec2 shown = Vec2(layout.plot_width, layout.plot_height) / layout.scale;
  layout.origin = 0.5 * (window.low + window.high) - 0.5 * shown;
  return layout;
}

// Only what lies on the side of the lines that normals come from is drawn until cairo_restore().
void keep_sides(cairo_t* cr, const PictureLayout& layout, const std::vector<SymmetryLine>& lines) {
  constexpr double far = 1e5; // px
  for (const SymmetryLine& line : lines) {
    const Vec2 p = layout.pixel(line.at), n(line.normal.x(), -line.normal.y());
    const bool upright = n.x() != 0.0;
    const double x = upright && n.x() < 0.0 ? p.x() : -far, y = !upright && n.y() < 0.0 ? p.y() : -far;
    cairo_rectangle(cr, x, y, (upright && n.x() > 0.0 ? p.x() : far) - x,
                    (!upright && n.y() > 0.0 ? p.y() : far) - y);
    cairo_clip(cr);
  }
}

void trace(cairo_t* cr, const PictureLayout& layout, const PictureTool& tool) {
  for (const Vec2& corner : tool.curve->polygon()) {
    const Vec2 p = layout.pixel(corner + tool.displacement);
    // Cairo works in 24.8 fixed point: far ends of a tool must not overflow.
    const Vec2 q = p.cwiseMax(Vec2::Constant(-2e5)).cwiseMin(Vec2::Constant(2e5));
    cairo_line_to(cr, q.x(), q.y());
  }
  cairo_close_path(cr);
}

void draw_symmetry(cairo_t* cr, const PictureLayout& layout, const SymmetryLine& line, double unit) {
  const Vec2 p = layout.pixel(line.at);
  const bool upright = line.normal.x() != 0.0;
  const Vec2 from = upright ? Vec2(p.x(), layout.plot_top) : Vec2(layout.plot_left, p.y());
  const Vec2 to = upright ? Vec2(p.x(), layout.plot_top + layout.plot_height)
                          : Vec2(layout.plot_left + layout.plot_width, p.y());
  const std::array<double, 4> dashes{26 * unit, 7 * unit, 4 * unit, 7 * unit};
  for (const bool on_top : {false, true}) {
    cairo_move_to(cr, from.x(), from.y());
    cairo_line_to(cr, to.x(), to.y());
    if (on_top) cairo_set_dash(cr, dashes.data(), 4, 0.0);
    const double grey = on_top ? 0.1 : 1.0;
    cairo_set_source_rgb(cr, grey, grey, grey);
    cairo_set_line_width(cr, (on_top ? 2.2 : 4.4) * unit);
    cairo_stroke(cr);
  }
  cairo_set_dash(cr, nullptr, 0, 0.0);
}

void draw_tool_name(cairo_t* cr, const PictureLayout& layout, const PictureTool& tool, double size) {
  Bounds bounds;
  for (const CurvePiece& piece : tool.curve->pieces)
    for (const double s : {0.0, 0.25, 0.5, 0.75})
      bounds.add(layout.pixel(piece.point(s) + tool.displacement));
  const Vec2 corner(layout.plot_left, layout.plot_top);
  Vec2 low = bounds.low.cwiseMax(corner);
  Vec2 high = bounds.high.cwiseMin(corner + Vec2(layout.plot_width, layout.plot_height));
  for (const SymmetryLine& line : tool.kept) { // pixels count downwards
    const Vec2 at = layout.pixel(line.at);
    if (line.normal.x() > 0.0) high.x() = std::min(high.x(), at.x());
    if (line.normal.x() < 0.0) low.x() = std::max(low.x(), at.x());
    if (line.normal.y() > 0.0) low.y() = std::max(low.y(), at.y());
    if (line.normal.y() < 0.0) high.y() = std::min(high.y(), at.y());
  }
  const Vec2 room = high - low;
  const double width = text_width(cr, tool.name, size);
  if (room.x() < width + 0.6 * size || room.y() < 1.3 * size) return;
  draw_rimmed_text(cr, tool.name, 0.5 * (low.x() + high.x()) - 0.5 * width,
                   0.5 * (low.y() + high.y()) + 0.36 * size, size);
}

// Mean distance of neighbouring nodes on the picture, px.
double cell_size(const PictureLayout& layout, const CellGeometry<2>& cells,
                 const std::vector<Vec2>& vertices) {
  double area = 0.0;
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c)
    for (auto b = cells.begin[c], e = cells.begin[c + 1], k = b; k < e; ++k)
      area += 0.5 * cross(vertices[index_of(cells.index[index_of(k)])],
                          vertices[index_of(cells.index[index_of(k + 1 < e ? k + 1 : b)])]);
  const auto count = static_cast<double>(std::max<std::size_t>(cells.begin.size(), 2) - 1);
  return std::sqrt(std::abs(area) / count) * layout.scale;
}

} // namespace

void show_field(Picture& picture, const Shown& field, const results::ShownUnits& units) {
  picture.label = field.label;
  picture.unit = units.chosen(field.unit).value_or(results::DisplayUnit{field.factor, field.unit});
  picture.map = field.map;
}

ColourRange usual_range(ColourMap map, std::span<const double> values) {
  return widened(map, value_span(map, values, usual_percentile(map)));
}

PictureWindow joined(const PictureWindow& one, const PictureWindow& other) {
  return {one.low.cwiseMin(other.low), one.high.cwiseMax(other.high)};
}

PictureLayout layout_picture(const Picture& picture) {
  check(picture);
  return layout_of(picture, results::moved_vertices<2>(*picture.cells, picture.position));
}

PictureWindow whole_window(const Picture& picture) {
  check(picture);
  return body_window(picture, results::moved_vertices<2>(*picture.cells, picture.position));
}

std::string draw_png(const Picture& picture) { return palette_png(draw(picture)); }

PaletteImage draw(const Picture& picture) {
  check(picture);
  const std::vector<Vec2> vertices = results::moved_vertices<2>(*picture.cells, picture.position);
  const PictureLayout layout = layout_of(picture, vertices);
  const double unit = picture.width / design_width, size = font * unit;
  const ColourRange range = picture.range ? *picture.range : usual_range(picture.map, picture.value);

  const Surface surface = make_surface(CAIRO_FORMAT_RGB24, layout.width, layout.height);
  const Context context = make_context(surface);
  cairo_t* cr = context.get();
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);

  cairo_save(cr);
  cairo_rectangle(cr, layout.plot_left, layout.plot_top, layout.plot_width, layout.plot_height);
  cairo_clip(cr);
  cairo_set_source_rgb(cr, 0.97, 0.97, 0.97);
  cairo_paint(cr);
  for (const PictureTool& tool : picture.tools) {
    cairo_save(cr);
    keep_sides(cr, layout, tool.kept);
    trace(cr, layout, tool);
    cairo_set_source_rgb(cr, 0.8, 0.8, 0.8);
    cairo_fill(cr);
    cairo_restore(cr);
  }
  paint_tools(cr, layout, picture, range);
  const bool lines = picture.edges.value_or(cell_size(layout, *picture.cells, vertices) > 7.0 * unit);
  CellRasters own;
  CellRasters& rasters = picture.rasters ? *picture.rasters : own;
  paint_cells(surface, picture, *rasters.of(layout, picture, vertices, lines ? 0.7 * unit : 0.0), range);
  for (const PictureTool& tool : picture.tools) {
    cairo_save(cr);
    keep_sides(cr, layout, tool.kept);
    trace(cr, layout, tool);
    cairo_set_source_rgb(cr, 0.34, 0.34, 0.34);
    cairo_set_line_width(cr, 2.0 * unit);
    cairo_stroke(cr);
    draw_tool_name(cr, layout, tool, 0.85 * size);
    cairo_restore(cr);
  }
  for (const SymmetryLine& line : picture.symmetry) draw_symmetry(cr, layout, line, unit);
  cairo_restore(cr);

  const double title_y = layout.plot_top - 0.85 * size, right = layout.plot_left + layout.plot_width;
  cairo_set_source_rgb(cr, 0.11, 0.11, 0.11);
  const std::string heading = picture.label;
  draw_text(cr, heading, layout.plot_left, title_y, 1.1 * size, true);
  const std::string time = "t = " + results::si_format(picture.time, "s", 4);
  draw_text(cr, time, right - text_width(cr, time, 1.1 * size), title_y, 1.1 * size);
  cairo_set_source_rgb(cr, 0.45, 0.45, 0.45);
  const double after = layout.plot_left + text_width(cr, heading, 1.1 * size, true) + size;
  if (after + text_width(cr, picture.title, size) + text_width(cr, time, 1.1 * size) + 2 * size < right)
    draw_text(cr, picture.title, after, title_y, size);

  draw_colour_bar(cr, layout, picture, range, unit, size);
  draw_scale_bar(cr, layout, unit, size);
  draw_extremes(cr, layout, picture, statement(picture), size);
  cairo_surface_flush(surface.get());
  cairo_surface_t* image = surface.get();
  PaletteImage drawn{layout.width,
                     layout.height,
                     {},
                     picture.darkness.empty() ? drawing_palette(picture.map, cell_line_shade)
                                              : lit_palette(picture.map, most_darkness)};
  drawn.index = nearest_colours({reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(image)),
                                 layout.width, layout.height,
                                 index_of(cairo_image_surface_get_stride(image)) / sizeof(std::uint32_t)},
                                drawn.palette);
  return drawn;
}

} // namespace cnem::report
