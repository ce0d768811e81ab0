#pragma once
// Stabilised conforming nodal integration: gradients smoothed over the constrained Voronoi cells
// (paper 004, (75)–(79)), and the links that stabilise them.
#include "cnem/quadrature.hpp"
#include "cnem/revolution.hpp"
#include "core/discretisation.hpp"
#include "voronoi/cells.hpp"

#include <cstdint>
#include <vector>

namespace cnem::scni {

/// The interior facets around each cell.
struct CellFacets {
  std::vector<std::int32_t> begin; ///< [cell + 1]
  std::vector<std::int32_t> facet; ///< in increasing order within a cell
};

CellFacets facets_of_cells(int nodes, const voronoi::Cells& cells);

/// b_iJ = (1/V_i) ∮ φ_J n dΓ, rows sorted by node, transpose built. Linear fields are reproduced because each
/// cell is a closed polygon and φ has linear precision at every Gauss point.
/// With `revolution` and means of r φ: b and h of a body of revolution (core/operators.hpp).
DiscreteOperators<2> smoothed_gradients(const Cloud<2>& cloud, const voronoi::Cells& cells,
                                        const CellFacets& around, const FacetMeans& means,
                                        const CentroidValues* revolution = nullptr);

/// The Delaunay edges, whose weight is the length of the facet between two cells over the distance of their
/// nodes, clamped to [0.1, 2]; an edge whose facet the boundary cuts away entirely gets 0.1. Sorted by
/// neighbour.
StabilisationLinks<2> delaunay_links(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                                     const voronoi::Cells& cells, const CellFacets& around);

} // namespace cnem::scni
