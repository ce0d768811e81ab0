#pragma once
// Delaunay triangulation of a cloud in space that holds its boundary.
#include "core/geometry/cloud.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// The tetrahedra inside the boundary: Delaunay ones away from it. Where facets are no faces of these,
/// tetrahedra are flipped until they are (facet_flips.hpp), which succeeds for most clouds that
/// recover_boundary() (recovery.hpp) has not seen and for all it returns; faces that touch are set apart for
/// it (opened.hpp). Tetrahedra begin with their lowest node and stand in the order of their nodes: they
/// follow from the positions and the set of facets alone. Right-handed by exact predicates; among cospherical
/// nodes that were turned a few may have no more volume than rounding. O(N log N).
///
/// Throws GeometryError, naming nodes with positions, for a surface that is open, branches, touches or
/// crosses itself or is inside out; nodes outside; coincident nodes that are no declared twins; positions
/// that are not finite; facets that stay lost, and tetrahedra between two facets that are flat to rounding
/// (the boundary has to be recovered first).
///
/// Bodies (Cloud::body) are triangulated each for itself, and may overlap.
///
/// A cloud that brings its tetrahedra (Cloud::simplices and across) gets these, in a small part of the time;
/// it is asserted that they are the same.
Tetrahedra triangulate(const Cloud<3>& cloud);

} // namespace cnem::voronoi
