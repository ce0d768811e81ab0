#include "voronoi/space/median_cells.hpp"

#include "core/index.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <algorithm>

namespace cnem::voronoi {
IndexedVector<PartIndex, BoundaryPart<3>> thirds_of_facets(const Cloud<3>& cloud) {
  using Place = std::array<double, 2>;
  constexpr Place corner[3] = {{0, 0}, {1, 0}, {0, 1}}, middle[3] = {{0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  IndexedVector<PartIndex, BoundaryPart<3>> parts;
  parts.reserve(6 * cloud.facets.size());
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t a = 0; a < 3; ++a) {
      const NodeIndex node = cloud.facets[f].node[a];
      parts.push_back({node, f, {corner[a], middle[a], facet_centroid}});
      parts.push_back({node, f, {corner[a], facet_centroid, middle[(a + 2) % 3]}});
    }
  return parts;
}

CellComplex<3> median_cells(const Cloud<3>& cloud, std::span<const Simplex<3>> tetrahedra) {
  CellComplex<3> cells;
  cells.volume.assign(cloud.position.size(), 0.0);
  cells.interior.reserve(12 * tetrahedra.size());
  std::vector<std::array<NodeIndex, 2>> edges;
  edges.reserve(6 * tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    std::array<Vec<3>, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = cloud.position[tetrahedra[t][k]];
    for (const NodeIndex i : tetrahedra[t]) cells.volume[index_of(i)] += 0.25 * measure<3>(x);
    const Vec<3> centre = (x[0] + x[1] + x[2] + x[3]) / 4.0;
    for (const auto& [a, b, c, d] : edges_of_tetrahedron) {
      const Vec<3> middle = (x[a] + x[b]) / 2.0, one = (x[a] + x[b] + x[c]) / 3.0,
                   other = (x[a] + x[b] + x[d]) / 3.0;
      const std::array<NodeIndex, 2> edge{tetrahedra[t][a], tetrahedra[t][b]};
      const auto in = as<SimplexIndex>(t);
      cells.interior.push_back({edge, {in, in}, {middle, one, centre}});
      cells.interior.push_back({edge, {in, in}, {middle, centre, other}});
      edges.push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  cells.neighbours = other_ends(cloud.position.size(), edges);
  cells.boundary = thirds_of_facets(cloud);
  return cells;
}

} // namespace cnem::voronoi
