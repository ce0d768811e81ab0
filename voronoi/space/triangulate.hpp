#pragma once
// Delaunay triangulation of a cloud in space that holds its boundary.
#include "core/geometry/cloud.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// The Delaunay tetrahedra of the nodes that are inside the boundary, whose facets have to be among their
/// faces: recover_boundary() (voronoi/space/recovery.hpp) makes clouds for which they are. Tetrahedra begin
/// with their lowest node and stand in the order of their nodes, so that they follow from the positions and
/// the set of facets alone. O(N log N).
///
/// Throws GeometryError, naming nodes with positions, for a surface that is open, branches, touches or
/// crosses itself or is inside out; nodes outside; coincident nodes that are no declared twins; positions
/// that are not finite; facets that are no faces of Delaunay tetrahedra, and tetrahedra on the boundary that
/// are flat to rounding (the boundary has to be recovered first).
Tetrahedra triangulate(const Cloud<3>& cloud);

} // namespace cnem::voronoi
