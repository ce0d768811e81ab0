#pragma once
// Stabilised conforming nodal integration on a cell complex: gradients smoothed over the cells (paper 004,
// (75)–(79)), and the links that stabilise them.
#include "cnem/nodal_rows.hpp"
#include "cnem/quadrature.hpp"
#include "cnem/revolution.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/operators/discretisation.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace cnem::scni {

/// A surface between two cells that functions are integrated on at once: a plane facet of several triangles.
template<int dim> struct Interface {
  std::array<NodeIndex, 2> cell; ///< i, j
  Vec<dim> area;                 ///< m^(dim−1), from i to j

  const Vec<dim>& normal() const { return area; }
};

/// Cells, seen from their faces: InnerFace or Interface.
template<int dim, class Face> struct FacesOfCells {
  const Field& volume; ///< [cell]
  std::span<const Face> inner;
  const CellLists<FaceIndex>& of_cell; ///< the inner ones of each cell
  const IndexedVector<PartIndex, BoundaryPart<dim>>& boundary;
  const CellLists<NodeIndex>& neighbours;
};
template<int dim>
FacesOfCells<dim, InnerFace<dim>> faces_between(const CellComplex<dim>& cells,
                                                const CellLists<FaceIndex>& faces) {
  return {cells.volume, cells.interior, faces, cells.boundary, cells.neighbours};
}

/// b_iJ = (1/V_i) ∮ φ_J n dΓ, rows sorted by node, transpose built; on the boundary φ is linear on each
/// facet. Linear fields are reproduced because each cell is closed and φ has linear precision at every
/// quadrature point. `faces`: faces_of_cells. With `revolution` and means of r φ, in the plane: b and h of a
/// body of revolution (core/operators/operators.hpp).
template<int dim, class Face>
DiscreteOperators<dim> smoothed_gradients(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells,
                                          FaceMeans means, const CentroidValues* revolution = nullptr);
/// Its rows. What they are made of may be let go of before they are joined, which takes as much memory again.
template<int dim, class Face>
UnjoinedRows<dim> smoothed_rows(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells,
                                FaceMeans means, const CentroidValues* revolution = nullptr);
template<int dim>
DiscreteOperators<dim> smoothed_gradients(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                          const CellLists<FaceIndex>& faces, FaceMeans means,
                                          const CentroidValues* revolution = nullptr) {
  return smoothed_gradients(cloud, faces_between(cells, faces), std::move(means), revolution);
}

/// The weight of a link: area of the faces between two cells over the distance d of their nodes, clamped to
/// [0.1, 2] in the plane, –, and to [0.05, 2] d in space, m.
template<int dim> double link_weight(double area, double distance) {
  constexpr double least = dim == 2 ? 0.1 : 0.05, most = 2.0;
  if constexpr (dim == 2)
    return std::clamp(area / distance, least, most);
  else
    return std::clamp(area / (distance * distance), least, most) * distance;
}

/// The neighbours of each cell with their weights, of those without a face the least.
template<int dim, class Face>
StabilisationLinks<dim> stabilisation_links(const Cloud<dim>& cloud, const FacesOfCells<dim, Face>& cells);
template<int dim>
StabilisationLinks<dim> stabilisation_links(const Cloud<dim>& cloud, const CellComplex<dim>& cells,
                                            const CellLists<FaceIndex>& faces) {
  return stabilisation_links(cloud, faces_between(cells, faces));
}

} // namespace cnem::scni
