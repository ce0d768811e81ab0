#pragma once
// Circumcircles of the Delaunay triangles: Voronoi vertices, and the in-circle test of natural neighbours.
#include "voronoi/triangulation.hpp"

#include <vector>

namespace cnem::voronoi {

/// One circle per triangle.
struct Circumcircles {
  std::vector<Vec2> centre;  ///< [triangle] m; may lie outside the triangle and beyond the boundary
  std::vector<double> limit; ///< [triangle] squared radius less the rounding error of |x − centre|², m²
};

Circumcircles circumcircles(const Cloud<2>& cloud, const Triangulation& mesh);

} // namespace cnem::voronoi
