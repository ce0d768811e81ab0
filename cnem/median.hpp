#pragma once
// Stabilised conforming nodal integration on median cells, with linear functions on tetrahedra: the node-based
// smoothed finite-element method (G.R. Liu, T. Nguyen-Thoi and others, Computers & Structures 87, 2009, 14).
#include "core/geometry/cell_complex.hpp"
#include "core/operators/discretisation.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::scni {

/// The tetrahedra at each node.
CellLists<SimplexIndex> tetrahedra_of_nodes(const voronoi::Tetrahedra& mesh);

/// Rows are nodes with their median cells (voronoi/space/median_cells.hpp), N is the identity, and by the
/// divergence theorem on them
///   V_i b_iJ = ¼ Σ_T V_T ∇N_J|_T over the tetrahedra T at node i, V_i = ¼ Σ_T V_T,
/// which area vectors alone give: V_T ∇N_J = −⅓ of that of the face opposite J, so that flat tetrahedra do no
/// harm. Linear fields are exact whatever the shape of the tetrahedra. O(N). Throws GeometryError, with its
/// place, for a node whose tetrahedra have no volume.
DiscreteOperators<3> median_gradients(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                      const CellLists<SimplexIndex>& around);

/// Links to the other nodes of the rows of these operators; weights as stabilisation_links, of the area
/// vectors of the facets.
StabilisationLinks<3> median_links(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                   const CellLists<SimplexIndex>& around, const DiscreteOperators<3>& rows);

} // namespace cnem::scni
