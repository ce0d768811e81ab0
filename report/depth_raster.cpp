// Which of several faces is seen at a pixel: the one nearest to the eye.
#include "core/index.hpp"
#include "report/cell_raster.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::report {
namespace {

/// The faces in px, and what has been seen of them.
class DepthBuffer {
public:
  explicit DepthBuffer(const PictureLayout& layout)
      : width_(layout.width), left_(static_cast<int>(layout.plot_left)),
        top_(static_cast<int>(layout.plot_top)), right_(left_ + static_cast<int>(layout.plot_width)),
        bottom_(top_ + static_cast<int>(layout.plot_height)),
        cell_(index_of(layout.width) * index_of(layout.height), -1), depth_(cell_.size(), -INFINITY) {}

  /// A convex polygon, px, with depths on one plane.
  void add(const std::vector<Vec2>& corner, const std::vector<double>& depth, std::int32_t number) {
    for (const Vec2& x : corner)
      if (!x.allFinite() || x.cwiseAbs().maxCoeff() > 1e6) return;
    const auto [gradient, base] = plane_of(corner, depth);
    if (!std::isfinite(base)) return; // seen from the side
    double low = INFINITY, high = -INFINITY;
    for (const Vec2& x : corner) {
      low = std::min(low, x.y());
      high = std::max(high, x.y());
    }
    const int first = std::max(top_, static_cast<int>(std::ceil(low - 0.5))),
              last = std::min(bottom_, static_cast<int>(std::ceil(high - 0.5)));
    for (int y = first; y < last; ++y) fill_row(corner, gradient, base, y, number);
  }

  int width() const { return width_; }
  const std::vector<std::int32_t>& cell() const { return cell_; }
  double depth(std::size_t k) const { return depth_[k]; }

private:
  struct Plane {
    Vec2 gradient;
    double base;
  };
  static Plane plane_of(const std::vector<Vec2>& corner, const std::vector<double>& depth) {
    double most = 0.0;
    Plane plane{Vec2::Zero(), NAN};
    for (std::size_t k = 2; k < corner.size(); ++k) { // of the largest triangle of the fan
      const Vec2 u = corner[k - 1] - corner[0], v = corner[k] - corner[0];
      const double twice = cross(u, v), du = depth[k - 1] - depth[0], dv = depth[k] - depth[0];
      if (!(std::abs(twice) > most)) continue;
      most = std::abs(twice);
      plane.gradient = Vec2(du * v.y() - dv * u.y(), dv * u.x() - du * v.x()) / twice;
      plane.base = depth[0] - plane.gradient.dot(corner[0]);
    }
    return plane;
  }

  void fill_row(const std::vector<Vec2>& corner, const Vec2& gradient, double base, int y,
                std::int32_t number) {
    const double middle = y + 0.5;
    double from = INFINITY, to = -INFINITY;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 *a = &corner[k], *b = &corner[k + 1 < corner.size() ? k + 1 : 0];
      if ((a->y() <= middle) == (b->y() <= middle)) continue;
      if (a->y() > b->y()) std::swap(a, b); // both faces of an edge see it in one place
      const double x = a->x() + (middle - a->y()) / (b->y() - a->y()) * (b->x() - a->x());
      from = std::min(from, x);
      to = std::max(to, x);
    }
    const int first = std::max(left_, static_cast<int>(std::ceil(std::max(from, -1e6) - 0.5))),
              last = std::min(right_, static_cast<int>(std::ceil(std::min(to, 1e6) - 0.5)));
    for (int x = first; x < last; ++x) {
      const std::size_t k = index_of(y) * index_of(width_) + index_of(x);
      const double depth = base + gradient.dot(Vec2(x + 0.5, middle));
      if (!(depth > depth_[k])) continue;
      depth_[k] = depth;
      cell_[k] = number;
    }
  }

  int width_, left_, top_, right_, bottom_;
  std::vector<std::int32_t> cell_;
  std::vector<double> depth_;
};

/// Lines where a body or a tool ends before what is behind: full on the nearer side, fainter beside it.
std::vector<std::uint8_t> rim_of(const DepthBuffer& buffer, std::size_t cells, double step) {
  const std::vector<std::int32_t>& cell = buffer.cell();
  const auto kind = [&](std::size_t k) { return cell[k] < 0 ? 0 : index_of(cell[k]) < cells ? 1 : 2; };
  std::vector<std::uint8_t> rim(cell.size(), 0);
  const auto width = index_of(buffer.width());
  const auto compare = [&](std::size_t a, std::size_t b) {
    if (kind(a) == 0 && kind(b) == 0) return;
    const bool behind = kind(a) == 0 || (kind(b) != 0 && buffer.depth(a) < buffer.depth(b));
    const double apart = std::abs(buffer.depth(a) - buffer.depth(b));
    if (kind(a) == kind(b) && !(apart > step)) return;
    const std::size_t near = behind ? b : a, far = behind ? a : b;
    rim[near] = 255;
    rim[far] = std::max<std::uint8_t>(rim[far], 110);
  };
  for (std::size_t k = 0; k + width < cell.size(); ++k) {
    if (k % width + 1 < width) compare(k, k + 1);
    compare(k, k + width);
  }
  return rim;
}

} // namespace

CellRaster rasterise(const PictureLayout& layout, const CellGeometry<2>& cells,
                     const std::vector<Vec2>& vertices, std::span<const double> depth,
                     const SolidFaces* solids) {
  DepthBuffer buffer(layout);
  std::vector<Vec2> corner;
  std::vector<double> height;
  const std::size_t count = cells.begin.empty() ? 0 : cells.begin.size() - 1;
  for (std::size_t c = 0; c < count; ++c) {
    corner.clear();
    height.clear();
    for (auto k = index_of(cells.begin[c]); k < index_of(cells.begin[c + 1]); ++k) {
      corner.push_back(layout.pixel(vertices[index_of(cells.index[k])]));
      height.push_back(depth[index_of(cells.index[k])]);
    }
    buffer.add(corner, height, as<std::int32_t>(c));
  }
  for (std::size_t f = 0; solids && f < solids->corner.size(); ++f) {
    corner.clear();
    height.clear();
    for (const Vec3& x : solids->corner[f]) {
      corner.push_back(layout.pixel(x.head<2>()));
      height.push_back(x.z());
    }
    buffer.add(corner, height, as<std::int32_t>(count + f));
  }
  const double shown = layout.plot_width / layout.scale; // m
  CellRaster raster;
  raster.rim = rim_of(buffer, count, 0.02 * shown);
  raster.cell = buffer.cell();
  return raster;
}

} // namespace cnem::report
