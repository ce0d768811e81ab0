#include "cnem/revolution.hpp"

#include "core/index.hpp"

#include <cassert>
#include <numbers>

namespace cnem::scni {
namespace {

/// Any triangle at each node.
IndexedVector<NodeIndex, SimplexIndex> triangle_at_nodes(std::size_t nodes,
                                                         const voronoi::Triangulation& triangulation) {
  IndexedVector<NodeIndex, SimplexIndex> triangle(nodes, SimplexIndex{});
  for (const SimplexIndex t : triangulation.node.indices())
    for (const NodeIndex i : triangulation.node[t]) triangle[i] = t;
  return triangle;
}

} // namespace

CentroidValues centroid_values(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                               const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                               voronoi::Functions functions) {
  const std::vector<Vec2> centroid = centroids(cloud, cells);
  const auto hint = triangle_at_nodes(centroid.size(), triangulation);
  CentroidValues result;
  result.radius.resize(centroid.size());
  result.begin.push_back(0);
  result.node.reserve(7 * centroid.size());
  result.value.reserve(7 * centroid.size());
  voronoi::NaturalNeighbours neighbours(cloud, triangulation, circles);
  for (std::size_t i = 0; i < centroid.size(); ++i) {
    assert(centroid[i].x() > 0.0);
    result.radius[i] = centroid[i].x();
    neighbours.evaluate(functions, centroid[i], hint[i]);
    result.node.insert(result.node.end(), neighbours.nodes().begin(), neighbours.nodes().end());
    result.value.insert(result.value.end(), neighbours.values().begin(), neighbours.values().end());
    result.begin.push_back(static_cast<std::int32_t>(result.node.size()));
  }
  return result;
}

void revolve(const Field& radius, StabilisationLinks<2>& links) {
  assert(radius.size() + 1 == links.begin.size());
  for (std::size_t i = 0; i + 1 < links.begin.size(); ++i)
    for (auto e = index_of(links.begin[i]); e < index_of(links.begin[i + 1]); ++e)
      links.weight[e] *= std::numbers::pi * (radius[i] + radius[index_of(links.neighbour[e])]);
}

} // namespace cnem::scni
