#pragma once
// Diagonals of the surface that its Delaunay triangulation has.
#include "voronoi/space/flippable_surface.hpp"
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

/// Flips edges near the facets that are lost, no faces of tetrahedra, while that leaves fewer facets and
/// edges which the tetrahedra do not have. Facets of one piece whose normals are within `flat_angle` (rad)
/// flip. fixed: as of FlippableSurface. The number of flips.
int fit_surface(Cloud<3>& cloud, const Delaunay& mesh, const std::vector<CloudFacetIndex>& lost,
                double flat_angle, const FixedNodes& fixed = {});

/// Flips the edge between two facets that a tetrahedron flat to rounding has on their inner side: flat ones
/// count as outside. What is below it may be flat, too: to be called until nothing flips.
int peel_flat(Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls, double flat_angle);

} // namespace cnem::voronoi
