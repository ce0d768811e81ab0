#pragma once
// Cells of the median dual of a mesh of tetrahedra.
#include "core/geometry/cell_complex.hpp"
#include "voronoi/linear_simplices.hpp"

#include <span>

namespace cnem::voronoi {

/// As in BoundaryPart::place.
inline constexpr std::array<double, 2> facet_centroid{1.0 / 3.0, 1.0 / 3.0};

/// The boundary of cells in space: of each facet two triangles a corner, from it over the middle of an edge
/// to the centroid. O(N).
IndexedVector<PartIndex, BoundaryPart<3>> thirds_of_facets(const Cloud<3>& cloud);

/// In each tetrahedron the cell of a corner is where its barycentric coordinate is the largest: a quarter of
/// the volume, bounded by quadrilaterals from the middle of each edge over the centroids of its two faces to
/// that of the tetrahedron. Cells close whatever the shape of the tetrahedra, which are right-handed and tile
/// the domain. O(N).
CellComplex<3> median_cells(const Cloud<3>& cloud, std::span<const Simplex<3>> tetrahedra);

} // namespace cnem::voronoi
