#pragma once
// The boundary of the tetrahedra inside as the new surface.
#include "voronoi/space/walls.hpp"

#include <cstdint>

namespace cnem::voronoi {

/// [tetrahedron] whether the surface winds round its centroid once, and it is not flat on a face.
IndexedVector<SimplexIndex, std::uint8_t> inside_by_winding(const Cloud<3>& cloud, const Delaunay& mesh);

struct Adopted {
  IndexedVector<CloudFacetIndex, Facet<3>> facets;
  int replaced = 0; ///< how many of them are new
};

/// The facets between the tetrahedra inside and the others, and those of slits: facets of the cloud that are
/// faces stay, in their order; after them new ones, in the order of their nodes, each with the piece of the
/// nearest facet that is gone. Whether they are a manifold with the same nodes is not asked. O(N + new ·
/// gone). Throws GeometryError where tetrahedra on both sides of a lost facet meet.
Adopted adopted_facets(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
                       const IndexedVector<SimplexIndex, std::uint8_t>& inside);

} // namespace cnem::voronoi
