// Any outline, holes, cracks and spacings or nodes: a cloud whose cells and operators keep their promises, or
// a GeometryError.
#include "cnem/scni.hpp"
#include "core/error.hpp"
#include "tests/fuzz/shapes.hpp"
#include "voronoi/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace cnem;

[[noreturn]] void fail(const char* what, double found, double expected) {
  std::fprintf(stderr, "%s: found %.17g, expected %.17g\n", what, found, expected);
  std::abort();
}

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

double polygon_area(const Cloud<2>& cloud) {
  const Vec2 origin = cloud.position[u(cloud.facets.front().node[0])];
  double area = 0.0;
  for (const Facet<2>& f : cloud.facets)
    area += 0.5 * cross(cloud.position[u(f.node[0])] - origin, cloud.position[u(f.node[1])] - origin);
  return area;
}

double extent(const Cloud<2>& cloud) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, (x - cloud.position.front()).norm());
  return size;
}

/// Largest rounding error of a coordinate, m.
double last_bit(const Cloud<2>& cloud) {
  double size = 0.0;
  for (const Vec2& x : cloud.position) size = std::max(size, x.cwiseAbs().maxCoeff());
  return 0x1p-52 * size;
}

/// Least height of a triangle over the size of the domain.
double thinness(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  double least = 1.0;
  for (const auto& [i, j, k] : mesh.node) {
    const Vec2 a = cloud.position[u(j)] - cloud.position[u(i)],
               b = cloud.position[u(k)] - cloud.position[u(i)];
    least = std::min(least, std::abs(cross(a, b)) / std::max({a.norm(), b.norm(), (b - a).norm()}));
  }
  return least / extent(cloud);
}

void check_cells(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  const voronoi::Circumcircles circles = voronoi::circumcircles(cloud, mesh);
  const voronoi::Cells cells = voronoi::constrained_cells(cloud, mesh, circles);
  const CellGeometry<2> polygons = voronoi::cell_geometry(cloud, mesh, circles, cells);
  if (polygons.begin.size() != cloud.position.size() + 1)
    fail("cell polygons", double(polygons.begin.size()), double(cloud.nodes()) + 1.0);
  double sum = 0.0;
  for (const double v : cells.volume) {
    if (!(v > 0.0)) fail("volume of a cell", v, 0.0);
    sum += v;
  }
  const double area = polygon_area(cloud), size = extent(cloud);
  if (!(std::abs(sum - area) <= 1e-11 * area + 100.0 * last_bit(cloud) * size))
    fail("sum of cells", sum, area);
}

/// Constants have no gradient, linear fields the right one.
void check_operators(const Cloud<2>& cloud, const DiscreteOperators<2>& op) {
  const double size = extent(cloud);
  for (std::size_t p = 0; p < u(op.points); ++p) {
    if (!(op.volume[p] > 0.0)) fail("volume of a point", op.volume[p], 0.0);
    const Vec2 origin = cloud.position[op.nodal ? p : u(op.node[u(op.row_begin[p])])];
    Vec2 sum = Vec2::Zero();
    Mat2 identity = Mat2::Zero();
    double total = 0.0, scale = 1.0;
    for (auto e = u(op.row_begin[p]); e < u(op.row_begin[p + 1]); ++e) {
      const Vec2 b(op.gradient[0][e], op.gradient[1][e]), r = cloud.position[u(op.node[e])] - origin;
      sum += b;
      identity += r * b.transpose();
      total += b.norm();
      scale += r.norm() * b.norm();
    }
    // Sums over the boundary of a thin cell are rounded before they are divided by its volume.
    const double thin = 100.0 * 0x1p-52 * size / op.volume[p];
    const double rounding = 20.0 * last_bit(cloud) * total + thin * size;
    if (!(sum.norm() <= 1e-11 * total + thin)) fail("gradient of a constant", sum.norm(), 0.0);
    const double error = (identity - Mat2::Identity()).norm();
    if (!(error <= 1e-11 * scale + rounding)) fail("gradient of a linear field", error, 0.0);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Shape shape = fuzz::shape_of(data, size);
  try {
    const voronoi::GeneratedCloud made = voronoi::generate_cloud(shape.domain, shape.spacing, shape.options);
    const voronoi::Triangulation mesh = voronoi::triangulate(made.cloud);
    check_cells(made.cloud, mesh);
    const bool smooth = shape.options.seed % 2 == 0;
    const auto functions = smooth ? scni::Functions::sibson : scni::Functions::laplace;
    const Approximation<2> built = scni::Cnem({.functions = functions}).rebuild(made.cloud);
    // The case reader lets no curves come closer than 1e-9 of their size, below which rounding decides.
    if (thinness(made.cloud, mesh) < 1e-9) return 0;
    check_operators(made.cloud, built.mechanics);
    check_operators(made.cloud, built.conduction); // the same as finite-element triangles
  } catch (const GeometryError&) {}                // refused with words
  return 0;
}
