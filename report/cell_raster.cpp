#include "report/cell_raster.hpp"

#include "core/index.hpp"
#include "report/picture_parts.hpp"

#include <algorithm>
#include <array>

namespace cnem::report {

namespace {

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

/// Numbers of cells as colours of 24 bits; where there are more cells, neighbours in the list share one.
struct CellColours {
  static constexpr std::uint32_t none = 0xFFFFFF;
  std::size_t shared;
  explicit CellColours(std::size_t cells) : shared(cells / none + 1) {}

  void set(cairo_t* cr, std::size_t cell) const {
    const std::size_t id = cell / shared;
    const auto channel = [&](int shift) { return static_cast<double>(id >> shift & 0xFFU) / 255.0; };
    cairo_set_source_rgb(cr, channel(16), channel(8), channel(0));
  }
  std::int32_t cell(std::uint32_t pixel) const {
    const std::uint32_t id = pixel & none;
    return id == none ? -1 : static_cast<std::int32_t>(id * shared);
  }
};

void fill_cells(cairo_t* cr, const View& view, const std::vector<Vec2>& pixel, const CellGeometry<2>& cells,
                const CellColours& colours) {
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
    colours.set(cr, c);
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

/// A context that draws on the plot alone, without antialiasing of its border.
Context plot_context(const Surface& surface, const PictureLayout& layout) {
  Context context = make_context(surface);
  cairo_set_antialias(context.get(), CAIRO_ANTIALIAS_NONE);
  cairo_rectangle(context.get(), layout.plot_left, layout.plot_top, layout.plot_width, layout.plot_height);
  cairo_clip(context.get());
  return context;
}

std::vector<std::uint8_t> edge_mask(const PictureLayout& layout, const View& view,
                                    const std::vector<Vec2>& pixel,
                                    const std::vector<std::array<std::int32_t, 2>>& edges, double line,
                                    cairo_line_cap_t cap) {
  const Surface mask = make_surface(CAIRO_FORMAT_A8, layout.width, layout.height);
  const Context context = plot_context(mask, layout);
  cairo_set_antialias(context.get(), CAIRO_ANTIALIAS_FAST);
  cairo_set_source_rgba(context.get(), 0.0, 0.0, 0.0, 1.0);
  cairo_set_line_width(context.get(), line);
  cairo_set_line_cap(context.get(), cap);
  stroke_edges(context.get(), view, pixel, edges);
  cairo_surface_flush(mask.get());
  std::vector<std::uint8_t> covered;
  covered.reserve(index_of(layout.width) * index_of(layout.height));
  for (int y = 0; y < layout.height; ++y) {
    const std::uint8_t* row =
        cairo_image_surface_get_data(mask.get()) + y * cairo_image_surface_get_stride(mask.get());
    covered.insert(covered.end(), row, row + layout.width);
  }
  return covered;
}

} // namespace

CellRaster rasterise(const PictureLayout& layout, const CellGeometry<2>& cells,
                     const std::vector<Vec2>& vertices, double line) {
  std::vector<Vec2> pixel(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) pixel[v] = layout.pixel(vertices[v]);
  const View view(layout);
  CellRaster raster;
  { // Without antialiasing neighbouring cells meet without seams, and are filled in a fraction of the time.
    const CellColours colours(cells.begin.empty() ? 0 : cells.begin.size() - 1);
    const Surface numbers = make_surface(CAIRO_FORMAT_RGB24, layout.width, layout.height);
    const Context context = plot_context(numbers, layout);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    fill_cells(context.get(), view, pixel, cells, colours);
    cairo_surface_flush(numbers.get());
    raster.cell.assign(index_of(layout.width) * index_of(layout.height), -1);
    const auto left = static_cast<int>(layout.plot_left), top = static_cast<int>(layout.plot_top);
    const int right = left + static_cast<int>(layout.plot_width),
              bottom = top + static_cast<int>(layout.plot_height);
    for (int y = top; y < bottom; ++y) {
      const auto* row = reinterpret_cast<const std::uint32_t*>(
          cairo_image_surface_get_data(numbers.get()) + y * cairo_image_surface_get_stride(numbers.get()));
      std::int32_t* cell = raster.cell.data() + index_of(y) * index_of(layout.width);
      for (int x = left; x < right; ++x) cell[x] = colours.cell(row[x]);
    }
  }
  const CellEdges edges = edges_of(cells);
  if (line > 0.0) raster.lines = edge_mask(layout, view, pixel, edges.inner, line, CAIRO_LINE_CAP_BUTT);
  raster.rim = edge_mask(layout, view, pixel, edges.rim, layout.width / 700.0, CAIRO_LINE_CAP_ROUND);
  return raster;
}

std::shared_ptr<const CellRaster> CellRasters::of(const PictureLayout& layout, const Picture& picture,
                                                  const std::vector<Vec2>& vertices, double line) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Made& made) {
    return made.line == line && made.layout == layout;
  });
  if (found != made_.end()) return found->raster;
  CellRaster raster = picture.depth.empty()
                          ? rasterise(layout, *picture.cells, vertices, line)
                          : rasterise(layout, *picture.cells, vertices, picture.depth, picture.solids);
  made_.push_back({layout, line, std::make_shared<const CellRaster>(std::move(raster))});
  return made_.back().raster;
}

} // namespace cnem::report
