#pragma once
// Straight ways through tetrahedra.
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// Outward normals of the faces of a tetrahedron, their lengths twice the areas, m².
std::array<Vec<3>, 4> face_normals(const std::array<Vec<3>, 4>& corner);

/// The corners of a tetrahedron, m.
std::array<Vec<3>, 4> corners_of(const Cloud<3>& cloud, const Tetrahedra& mesh, SimplexIndex tetrahedron);

/// End of a walk.
struct SpaceWalkEnd {
  SimplexIndex tetrahedron; ///< the last that was reached
  CloudFacetIndex facet;    ///< the wall that stopped it; none: the target is in `tetrahedron`
  Vec<3> place;             ///< m, the target or where the way leaves the body
};

/// Walks straight from the centroid of tetrahedron `from` to x and stops at the first wall.
SpaceWalkEnd walk(const Cloud<3>& cloud, const Tetrahedra& mesh, SimplexIndex from, const Vec<3>& x);

} // namespace cnem::voronoi
