#pragma once
// The tetrahedra inside a boundary, numbered by their nodes.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

/// Tetrahedra from their lowest node on, in the order of their nodes. O(N). Throws GeometryError, naming
/// nodes, for nodes that have none, and for tetrahedra that are flat to rounding and have two facets.
Tetrahedra filling(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
                   const IndexedVector<SimplexIndex, std::uint8_t>& inside);

/// Whether a corner is so near the plane of the others that rounding decides on which side.
bool is_flat(const std::array<Vec3, 4>& corner);

} // namespace cnem::voronoi
