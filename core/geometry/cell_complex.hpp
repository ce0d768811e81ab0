#pragma once
// What stands between the geometry of a cloud and its operators: a cell for each node, the faces between
// cells and the parts of the boundary. Smoothed gradients and links (cnem/smoothing.hpp) and the error
// indicator (adapt/indicator.hpp) are written on it, once for all dimensions.
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/facets.hpp"
#include "core/indexed.hpp"

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem {

/// A face between two cells: a segment in the plane, a triangle in space, where faces with more corners are
/// divided.
template<int dim> struct InnerFace {
  std::array<NodeIndex, 2> cell; ///< i, j
  /// Where to look for its points from, in the plane to both sides of its edge; none: the edge is on
  /// the boundary.
  std::array<SimplexIndex, 2> simplex;
  std::array<Vec<dim>, dim> corner; ///< m; may coincide

  /// From i to j, its length the area of the face, m^(dim−1).
  Vec<dim> normal() const { return area_normal<dim>(corner); }
};

/// The part of a boundary facet that bounds a cell, which need not be that of a corner of the facet. A
/// segment in the plane, a triangle in space, turned like its facet.
template<int dim> struct BoundaryPart {
  NodeIndex cell;
  CloudFacetIndex facet;
  /// [corner] t, x = x_0 + Σ_k t_k (x_(k+1) − x_0) with the corners x_a of the facet.
  std::array<std::array<double, dim - 1>, dim> place;

  /// Nodal shares (1/|Γ|) ∫ φ_a dΓ over the part, with the linear functions φ and the area |Γ| of its facet:
  /// over all parts of a facet they sum to 1/dim each.
  std::array<double, dim> shares() const;

  /// Its corners on a facet with these corners, m.
  std::array<Vec<dim>, dim> on(const std::array<Vec<dim>, dim>& facet_corner) const {
    std::array<Vec<dim>, dim> corner;
    for (std::size_t a = 0; a < dim; ++a) corner[a] = point_on<dim>(facet_corner, place[a]);
    return corner;
  }
};

/// A point of a face, and its weight; weights of a rule sum to 1.
template<int dim> struct FacePoint {
  std::array<double, dim - 1> place; ///< as in BoundaryPart
  double weight;
};

/// Quadrature points of a face. In the plane Gauss's 1, 2 or 3, exact for polynomials of degree 1, 3, 5; in
/// space the centroid or, for 2 and 3, three points, exact for degree 1 and 2.
template<int dim> std::span<const FacePoint<dim>> face_rule(int points);

/// Lists of items for each cell: indices of faces or parts, other cells.
template<class Item> struct CellLists {
  std::vector<std::int32_t> begin; ///< [cell + 1]
  std::vector<Item> item;          ///< in increasing order within a cell

  std::span<const Item> of(std::size_t cell) const {
    assert(cell + 1 < begin.size());
    return {item.data() + begin[cell], item.data() + begin[cell + 1]};
  }
  std::span<const Item> of(NodeIndex cell) const { return of(index_of(cell)); }
};

/// Cells of all nodes of a cloud. Each is closed: the normals of its faces and parts sum to zero, and by the
/// divergence theorem they give its volume (`is_closed`).
template<int dim> struct CellComplex {
  Field volume; ///< [cell] m² (per unit thickness) or m³
  IndexedVector<FaceIndex, InnerFace<dim>> interior;
  IndexedVector<PartIndex, BoundaryPart<dim>> boundary; ///< facet after facet
  /// The cells that each is linked with: the ends of the edges of the simplices. All that share a face are.
  CellLists<NodeIndex> neighbours;

  std::size_t cells() const { return volume.size(); }
};

/// Counts the items of each cell and lists them: cells_of(k) gives the cells that have item k, item_of(k,
/// cell) what stands for it in the list of one.
template<class CellsOf, class ItemOf>
auto group_by_cell(std::size_t cells, std::size_t items, CellsOf&& cells_of, ItemOf&& item_of) {
  CellLists<decltype(item_of(items, NodeIndex::none))> lists;
  lists.begin.assign(cells + 1, 0);
  for (std::size_t k = 0; k < items; ++k)
    for (const NodeIndex i : cells_of(k)) ++lists.begin[index_of(i) + 1];
  for (std::size_t i = 0; i < cells; ++i) lists.begin[i + 1] += lists.begin[i];
  lists.item.resize(index_of(lists.begin.back()));
  std::vector<std::int32_t> next(lists.begin.begin(), lists.begin.end() - 1);
  for (std::size_t k = 0; k < items; ++k)
    for (const NodeIndex i : cells_of(k)) lists.item[index_of(next[index_of(i)]++)] = item_of(k, i);
  return lists;
}
/// The same with the indices of the items.
template<IndexKind Item, class CellsOf>
CellLists<Item> group_by_cell(std::size_t cells, std::size_t items, CellsOf&& cells_of) {
  return group_by_cell(cells, items, cells_of, [](std::size_t k, NodeIndex) { return as<Item>(k); });
}

/// The inner faces of each cell.
template<int dim> CellLists<FaceIndex> faces_of_cells(const CellComplex<dim>& complex) {
  return group_by_cell<FaceIndex>(
      complex.cells(),
      complex.interior.size(), [&](std::size_t f) -> const auto& { return complex.interior[f].cell; });
}
/// The parts of the boundary of each cell.
template<int dim> CellLists<PartIndex> parts_of_cells(const CellComplex<dim>& complex) {
  return group_by_cell<PartIndex>(complex.cells(), complex.boundary.size(),
                                  [&](std::size_t f) { return std::array{complex.boundary[f].cell}; });
}
/// The other ends of the edges at each cell; each edge is given once.
CellLists<NodeIndex> other_ends(std::size_t cells, std::span<const std::array<NodeIndex, 2>> edges);

/// Centroids of the cells, [cell] m. O(N).
std::vector<Vec2> centroids(const Cloud<2>& cloud, const CellComplex<2>& cells);

/// Whether each cell is closed and has the volume that its faces and parts enclose, to rounding: 1e-13 of the
/// coordinates in the sum of normals. For assertions; O(N).
template<int dim> bool is_closed(const Cloud<dim>& cloud, const CellComplex<dim>& complex);

extern template struct BoundaryPart<2>;
extern template struct BoundaryPart<3>;

} // namespace cnem
