#pragma once
// The tetrahedra inside a boundary, numbered by their nodes.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

/// Of a cloud whose surface is one and its Delaunay triangulation, which is flipped where it lacks facets:
/// tetrahedra from their lowest node on, in the order of their nodes. O(N). Throws GeometryError, naming
/// nodes, as triangulate().
Tetrahedra filling(const Cloud<3>& cloud, Delaunay mesh);

/// Whether a corner is so near the plane of the others that rounding decides on which side.
bool is_flat(const std::array<Vec3, 4>& corner);

} // namespace cnem::voronoi
