#pragma once
// Circumcircles of the Delaunay triangles: Voronoi vertices, and the in-circle test of natural neighbours.
#include "voronoi/plane/triangulation.hpp"

#include <vector>

namespace cnem::voronoi {

/// One circle per triangle.
struct Circumcircles {
  IndexedVector<SimplexIndex, Vec2> centre; ///< m; may lie outside the triangle and beyond the boundary
  IndexedVector<SimplexIndex, double> limit; ///< squared radius less the rounding error of |x − centre|², m²
};

Circumcircles circumcircles(const Cloud<2>& cloud, const Triangulation& mesh);

} // namespace cnem::voronoi
