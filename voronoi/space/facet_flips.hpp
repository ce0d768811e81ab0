#pragma once
// Flips of tetrahedra until they have the facets of a boundary among their faces.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

/// Brings edges of lost facets and then the facets themselves into the tetrahedra, by exchanging two
/// tetrahedra for three and those round an edge for others, one crossing after the other; facets and edges of
/// the surface that are there stay. The nodes stay where they are; tetrahedra near the facets are no longer
/// Delaunay. Walls of the cloud in the new tetrahedra. O(N) where facets are lost, else O(1).
Walls hold_facets(const Cloud<3>& cloud, Delaunay& mesh, Walls walls);

} // namespace cnem::voronoi
