#pragma once
// Corners of the cells in space: one point a tetrahedron, one a facet of the boundary.
#include "voronoi/space/circumspheres.hpp"
#include "voronoi/space/edge_rings.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// Of a tetrahedron the circumcentre, or where the straight way to it from the centroid leaves the body; of a
/// facet the centroid: with circumcentres neighbours on an edge of the body have shares that differ by a
/// factor, and metal that spreads there moves them out and in in turn. Cells close and fill the body wherever
/// the points are.
struct DualPoints {
  IndexedVector<DualPointIndex, Vec<3>> place;      ///< m
  IndexedVector<SimplexIndex, SimplexIndex> holder; ///< the tetrahedron that the point of each lies in
};

/// O(N).
DualPoints dual_points(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres);

/// Takes the point of a tetrahedron half of the way to its centroid.
void draw_in(const Cloud<3>& cloud, const Tetrahedra& mesh, DualPoints& points, SimplexIndex tetrahedron);

} // namespace cnem::voronoi
