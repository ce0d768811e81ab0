#pragma once
// The parts a picture is put together from. Private to picture.cpp.
#include "report/picture.hpp"

#include <cairo.h>

#include <memory>
#include <string>

namespace cnem::report {

struct CairoDelete {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, CairoDelete>;
using Context = std::unique_ptr<cairo_t, CairoDelete>;

/// Throw IoError when there is no memory for them.
Surface make_surface(cairo_format_t format, int width, int height);
Context make_context(const Surface& surface);

double text_width(cairo_t* cr, const std::string& text, double size, bool bold = false);
void draw_text(cairo_t* cr, const std::string& text, double x, double y, double size, bool bold = false);

/// Dark on a light rim, to be read on any colour.
void draw_rimmed_text(cairo_t* cr, const std::string& text, double x, double y, double size);

/// How much darker lines between cells are than the cells.
inline constexpr double cell_line_shade = 0.4;
/// How much darker what turns from the light is at most.
inline constexpr double most_darkness = 0.42;

struct CellRaster;
/// Cells filled with the colours of their values, seamless, the lines between them, and a thin dark rim
/// around the body.
void paint_cells(const Surface& surface, const Picture& picture, const CellRaster& raster,
                 const ColourRange& range);

/// Tools that conduct, with the colours of their temperatures on the scale of the body.
void paint_tools(cairo_t* cr, const PictureLayout& layout, const Picture& picture, const ColourRange& range);

// `unit` is the size of a design pixel, `size` that of the font, both in px.
void draw_colour_bar(cairo_t* cr, const PictureLayout& layout, const Picture& picture,
                     const ColourRange& range, double unit, double size);
void draw_scale_bar(cairo_t* cr, const PictureLayout& layout, double unit, double size);
/// Least and greatest value of the whole field, in the lower right corner, and below them `statement`.
void draw_extremes(cairo_t* cr, const PictureLayout& layout, const Picture& picture,
                   const std::string& statement, double size);

} // namespace cnem::report
