#pragma once
// Exchanges of tetrahedra that are flat to rounding.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

/// Exchanges flat tetrahedra (is_flat()) inside and their neighbours for others which are not: of cospherical
/// nodes, as on a lattice that was turned, Delaunay tetrahedra may have the volume that rounding left. Facets
/// stay. Whether there were any. O(N).
bool exchange_flat(const Cloud<3>& cloud, Delaunay& mesh,
                   const IndexedVector<SimplexIndex, std::uint8_t>& inside);

} // namespace cnem::voronoi
