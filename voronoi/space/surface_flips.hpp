#pragma once
// Diagonals of the surface that a Delaunay triangulation of its nodes is likely to have.
#include "voronoi/space/flippable_surface.hpp"

namespace cnem::voronoi {

/// Lawson's flips: of two facets of one piece whose normals are within `flat_angle` (rad) the common edge
/// becomes the other diagonal where the angles across from it are more than π together and the facets after
/// it are not folded. Facets on one plane follow exact predicates and, of cocircular nodes, the perturbation
/// of the Delaunay triangulation, so that on a plane face of the convex hull none is lost. The two faces of a
/// slit flip together. fixed: as of FlippableSurface. The number of flips. O(facets).
int flip_surface(Cloud<3>& cloud, double flat_angle, const FixedNodes& fixed = {});

} // namespace cnem::voronoi
