#include "cnem/revolution.hpp"

#include "core/index.hpp"

#include <cassert>
#include <numbers>

namespace cnem::scni {
namespace {

/// ∮ ½ (ρ_x² n_x, ρ_y² n_y) ds over a segment, ρ from `origin`, n ds the right normal of the segment: its
/// share of the first moments of area.
Vec2 first_moment(const Vec2& origin, const std::array<Vec2, 2>& end) {
  const Vec2 a = end[0] - origin, b = end[1] - origin;
  const Vec2 mean_square = (a.cwiseProduct(a) + a.cwiseProduct(b) + b.cwiseProduct(b)) / 3.0;
  return 0.5 * mean_square.cwiseProduct(right_normal(end[1] - end[0]));
}

std::vector<Vec2> centroids(const Cloud<2>& cloud, const CellComplex<2>& cells) {
  std::vector<Vec2> moment(cloud.position.size(), Vec2::Zero());
  for (const InnerFace<2>& face : cells.interior) {
    const std::size_t i = index_of(face.cell[0]), j = index_of(face.cell[1]);
    moment[i] += first_moment(cloud.position[i], face.corner);
    moment[j] -= first_moment(cloud.position[j], face.corner);
  }
  for (const BoundaryPart<2>& part : cells.boundary) {
    const std::size_t i = index_of(part.cell);
    moment[i] +=
        first_moment(cloud.position[i], part.on(corners_of<2>(cloud.facets[part.facet], cloud.position)));
  }
  for (std::size_t i = 0; i < moment.size(); ++i) moment[i] = cloud.position[i] + moment[i] / cells.volume[i];
  return moment;
}

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
