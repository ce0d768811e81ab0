#pragma once
// Flips of tetrahedra until they have the facets of a boundary among their faces.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

struct HeldFacets {
  Walls walls;          ///< of the cloud in the new tetrahedra
  bool at_once = false; ///< whether all are there by the first of the orders in which they are brought back
};

/// Brings edges of lost facets and then the facets themselves into the tetrahedra, by exchanging two
/// tetrahedra for three and those round an edge for others, one crossing after the other; facets and edges of
/// the surface that are there stay. The nodes stay where they are; tetrahedra near the facets are no longer
/// Delaunay. Lost facets are brought back in up to so many orders, until none is lost. O(N + lost · facets)
/// where facets are lost, else O(1). Throws GeometryError, naming the nodes, where a lost facet crosses
/// another.
HeldFacets hold_facets(const Cloud<3>& cloud, Delaunay& mesh, Walls walls, int orders = 6);

} // namespace cnem::voronoi
