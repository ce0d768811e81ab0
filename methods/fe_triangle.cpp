#include "methods/fe_triangle.hpp"

#include "voronoi/linear_triangles.hpp"

#include <numeric>

namespace cnem::methods {
namespace {

CellGeometry<2> triangle_cells(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation) {
  CellGeometry<2> cells;
  cells.vertex = cloud.position;
  cells.begin.reserve(triangulation.node.size() + 1);
  cells.index.reserve(3 * triangulation.node.size());
  cells.begin.push_back(0);
  for (const auto& corner : triangulation.node) {
    cells.index.insert(cells.index.end(), corner.begin(), corner.end());
    cells.begin.push_back(static_cast<std::int32_t>(cells.index.size()));
  }
  cells.vertex_begin.resize(cloud.position.size() + 1);
  std::iota(cells.vertex_begin.begin(), cells.vertex_begin.end(), 0);
  cells.vertex_node.assign(cells.vertex_begin.begin(), cells.vertex_begin.end() - 1);
  cells.vertex_weight.assign(cloud.position.size(), 1.0);
  return cells;
}

} // namespace

Approximation<2> FeTriangles::rebuild(const Cloud<2>& cloud) {
  const voronoi::Triangulation triangulation = voronoi::triangulate(cloud);
  Approximation<2> result;
  result.mechanics = voronoi::linear_triangles(cloud, triangulation, space_);
  result.conduction = result.mechanics;
  result.node_volume = result.mechanics.node_volume();
  result.links.begin.assign(cloud.position.size() + 1, 0);
  result.cells = triangle_cells(cloud, triangulation);
  return result;
}

} // namespace cnem::methods
