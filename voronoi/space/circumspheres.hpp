#pragma once
// Circumspheres of tetrahedra: Voronoi vertices, and the in-sphere test of natural neighbours.
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// One sphere a tetrahedron.
struct Circumspheres {
  IndexedVector<SimplexIndex, Vec<3>> centre; ///< m; may lie outside the tetrahedron and beyond the boundary
  IndexedVector<SimplexIndex, double> limit; ///< squared radius less the rounding error of |x − centre|², m²
};

/// Tetrahedra that are flat to rounding (six times their volume below 1e-10 of the product of three edges)
/// have no centre of their own: of four nodes on a circle any point of its axis is one. They get the mean of
/// those of their neighbours that are not flat, as the limit of tetrahedra less flat would be between
/// them; with no such neighbour their centroid. O(N).
Circumspheres circumspheres(const Cloud<3>& cloud, const Tetrahedra& mesh);

} // namespace cnem::voronoi
