#pragma once
// Constrained Delaunay triangulation of a cloud, as plain arrays. CGAL stays behind triangulation.cpp.
#include "core/geometry/cloud.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// The constrained Delaunay triangles inside the domain. Topology is two-sided at cracks: the triangles on
/// either face carry that face's own (duplicated) nodes, so nothing that walks over `neighbour` ever crosses
/// a wall.
struct Triangulation {
  /// Nodes, counter-clockwise from the lowest; triangles by their first and second node.
  IndexedVector<SimplexIndex, std::array<NodeIndex, 3>> node;
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>>
      neighbour; ///< [triangle][k] across the edge opposite node k; none: boundary
  IndexedVector<SimplexIndex, std::array<CloudFacetIndex, 3>>
      facet; ///< [triangle][k] on that edge; none: interior edge
  IndexedVector<NodeIndex, SimplexIndex>
      triangle_of_node; ///< the first that has it; of boundary nodes, the first counter-clockwise

  int triangles() const { return static_cast<int>(node.size()); }
};

/// Counter-clockwise after corner k of a triangle.
inline std::int32_t next_corner(std::int32_t k) { return k == 2 ? 0 : k + 1; }

/// Triangulates the domain bounded by the cloud's facets, each body for itself (Cloud::body). O(N log N).
/// Throws GeometryError, with positions, for: an empty domain, facets that do not form closed loops or run
/// the wrong way round, loops that cross themselves or each other, nodes outside the domain or on a facet
/// that is not theirs, coincident nodes that are not declared twins, non-finite positions.
Triangulation triangulate(const Cloud<2>& cloud);

} // namespace cnem::voronoi
