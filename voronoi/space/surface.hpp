#pragma once
// The boundary of a cloud in space as a surface: which facet is across which edge, and what can be said about
// it before anything is triangulated.
#include "core/geometry/cloud.hpp"

#include <array>
#include <string>

namespace cnem::voronoi {

/// Edge k of a facet, from its node k to the next, as 3 · facet + k.
using SurfaceEdge = std::int32_t;

inline CloudFacetIndex facet_of(SurfaceEdge edge) { return static_cast<CloudFacetIndex>(edge / 3); }
inline std::size_t place_of(SurfaceEdge edge) { return static_cast<std::size_t>(edge % 3); }
inline SurfaceEdge edge_at(CloudFacetIndex facet, std::size_t k) {
  return 3 * static_cast<std::int32_t>(facet) + static_cast<std::int32_t>(k);
}
/// The next one of the same facet.
inline SurfaceEdge next_edge(SurfaceEdge edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }

/// [facet][k] the edge that runs the other way.
using SurfaceEdges = IndexedVector<CloudFacetIndex, std::array<SurfaceEdge, 3>>;

/// "node 12 at (0.001, 0.002, 0) m".
std::string describe_node(const Cloud<3>& cloud, NodeIndex node);

/// "facet 7 between nodes 1 at (…), 2 at (…), 3 at (…) m".
std::string describe_facet(const Cloud<3>& cloud, CloudFacetIndex facet);

/// Who is across which edge. O(facets). Throws GeometryError, naming nodes with positions, for positions that
/// are not finite, facets and twins that name absent nodes or one node twice, an empty boundary, edges at
/// which the surface is open, branches or turns inside out, and nodes at which it touches itself.
SurfaceEdges surface_edges(const Cloud<3>& cloud);

/// [facet] the one of the other face of a slit, at the same places the other way round; none: it has none.
IndexedVector<CloudFacetIndex, CloudFacetIndex> facets_behind(const Cloud<3>& cloud);

/// Throws the GeometryError that says where the boundary crosses itself, naming the two facets, if one of the
/// given facets crosses another. O(given · facets).
void refuse_crossings(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& suspects);

} // namespace cnem::voronoi
