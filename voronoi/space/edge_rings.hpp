#pragma once
// What stands round each edge of tetrahedra: the corners of the facet between its two cells.
#include "voronoi/space/tetrahedra.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cnem::voronoi {

/// Dual points are counted tetrahedron by tetrahedron, after them facet by facet of the boundary.
constexpr DualPointIndex dual_point_of(SimplexIndex tetrahedron) {
  return as<DualPointIndex>(index_of(tetrahedron));
}
inline DualPointIndex dual_point_of(const Tetrahedra& mesh, CloudFacetIndex facet) {
  return as<DualPointIndex>(mesh.node.size() + index_of(facet));
}

struct EdgeRings {
  IndexedVector<EdgeIndex, std::array<NodeIndex, 2>> end; ///< the lower one first
  std::vector<std::int32_t> begin;                        ///< [edge + 1]
  /// The tetrahedra round each edge, counter-clockwise about the way from its first end to its second. At
  /// edges of the boundary the ring is open: it begins and ends with the points of facets. Where the body
  /// touches itself along an edge this has a ring for each part, and stands here several times.
  std::vector<DualPointIndex> point;

  std::span<const DualPointIndex> of(EdgeIndex edge) const {
    return {point.data() + begin[index_of(edge)], point.data() + begin[index_of(edge) + 1]};
  }
};

/// In the order of the lowest tetrahedron of closed rings, the first of open ones. O(N).
EdgeRings edge_rings(const Tetrahedra& mesh);

} // namespace cnem::voronoi
