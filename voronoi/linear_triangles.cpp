#include "voronoi/linear_triangles.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::voronoi {
namespace {

[[noreturn]] void throw_flat_triangle(const Vec2& a, const Vec2& b, const Vec2& c) {
  throw GeometryError(
      fmt::format("the Delaunay triangle ({:g}, {:g}) ({:g}, {:g}) ({:g}, {:g}) has no area: the nodes "
                  "on this part of the boundary have to leave room for a node or an edge across it",
                  a.x(), a.y(), b.x(), b.y(), c.x(), c.y()));
}

} // namespace

DiscreteOperators<2> linear_triangles(const Cloud<2>& cloud, const Triangulation& triangulation,
                                      Space space) {
  const auto triangles = static_cast<std::size_t>(triangulation.triangles());
  DiscreteOperators<2> op;
  op.points = triangulation.triangles();
  op.nodes = cloud.nodes();
  op.volume.resize(triangles);
  op.row_begin.resize(triangles + 1);
  op.node.resize(3 * triangles);
  for (Field& f : op.gradient) f.resize(3 * triangles);
  op.value.assign(3 * triangles, 1.0 / 3.0);
  op.row_begin[triangles] = static_cast<std::int32_t>(3 * triangles);

#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < triangles; ++t) {
    // Rotating the corners until the lowest node stands first leaves at most one swap to sort the row.
    std::array<std::int32_t, 3> corner = triangulation.node[t];
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    std::array<Vec2, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = cloud.position[static_cast<std::size_t>(corner[k])];
    const double twice_area = cross(x[1] - x[0], x[2] - x[0]);

    op.volume[t] = 0.5 * twice_area;
    op.row_begin[t] = static_cast<std::int32_t>(3 * t);
    const bool swap = corner[2] < corner[1];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 b = left_normal(x[(k + 2) % 3] - x[(k + 1) % 3]) / twice_area;
      const std::size_t e = 3 * t + (swap && k > 0 ? 3 - k : k);
      op.node[e] = corner[k];
      op.gradient[0][e] = b.x();
      op.gradient[1][e] = b.y();
    }
  }

  for (std::size_t t = 0; t < triangles; ++t)
    if (!(op.volume[t] > 0.0)) {
      const auto& corner = triangulation.node[t];
      throw_flat_triangle(cloud.position[static_cast<std::size_t>(corner[0])],
                          cloud.position[static_cast<std::size_t>(corner[1])],
                          cloud.position[static_cast<std::size_t>(corner[2])]);
    }

  if (space == Space::revolution) {
    op.radius.resize(triangles);
    op.hoop.resize(3 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      double sum = 0.0;
      for (const std::int32_t i : triangulation.node[t])
        sum += cloud.position[static_cast<std::size_t>(i)].x();
      op.radius[t] = sum / 3.0;
      op.volume[t] *= 2.0 * std::numbers::pi * op.radius[t];
      for (std::size_t e = 3 * t; e < 3 * t + 3; ++e) op.hoop[e] = op.value[e] / op.radius[t];
    }
  }
  op.build_transpose();
  return op;
}

} // namespace cnem::voronoi
