#pragma once
// Stabilised conforming nodal integration on a cell complex: gradients smoothed over the cells (paper 004,
// (75)–(79)), and the links that stabilise them.
#include "cnem/quadrature.hpp"
#include "cnem/revolution.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/operators/discretisation.hpp"

namespace cnem::scni {

/// b_iJ = (1/V_i) ∮ φ_J n dΓ, rows sorted by node, transpose built; on the boundary φ is linear on each
/// facet. Linear fields are reproduced because each cell is closed and φ has linear precision at every
/// quadrature point. `faces`: faces_of_cells. With `revolution` and means of r φ, in the plane: b and h of a
/// body of revolution (core/operators/operators.hpp).
template<int dim>
DiscreteOperators<dim> smoothed_gradients(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                          const CellLists<FaceIndex>& faces, const FaceMeans& means,
                                          const CentroidValues* revolution = nullptr);

/// The neighbours of each cell; their weight is the area of the faces between two cells over the distance d
/// of their nodes, clamped to [0.1, 2] in the plane, –, and to [0.05, 2] d in space, m; of neighbours without
/// a face the least.
template<int dim>
StabilisationLinks<dim> stabilisation_links(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                            const CellLists<FaceIndex>& faces);

} // namespace cnem::scni
