#pragma once
// Where a point lies among the triangles of the domain.
#include "voronoi/plane/triangulation.hpp"

#include <array>
#include <cstdint>

namespace cnem::voronoi {

/// End of a straight walk through the triangles.
struct WalkEnd {
  SimplexIndex triangle; ///< the last triangle that was reached
  CloudFacetIndex facet; ///< the wall that stopped the walk; none: the target lies in `triangle`
};

/// Walks straight from the centroid of triangle `from` to x and stops at the first wall.
WalkEnd walk(const Cloud<2>& cloud, const Triangulation& mesh, SimplexIndex from, const Vec2& x);

/// Barycentric coordinates of x in a triangle; negative ones outside it.
std::array<double, 3> barycentric(const Cloud<2>& cloud, const Triangulation& mesh, SimplexIndex triangle,
                                  const Vec2& x);

/// A point in barycentric coordinates of a triangle.
struct Location {
  SimplexIndex triangle;
  std::array<double, 3> weight; ///< sum to 1; linear functions are reproduced
  bool inside;                  ///< x lies in the domain, within 1e-9 of the size of the triangle
};

/// The triangle that contains x, or else the one that x is the least outside of. Walks from `hint` and
/// searches all triangles only when a wall stops the walk. On a crack the face on the hint's side is taken.
Location locate(const Cloud<2>& cloud, const Triangulation& mesh, const Vec2& x, SimplexIndex hint = {});

} // namespace cnem::voronoi
