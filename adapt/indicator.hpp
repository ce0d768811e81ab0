#pragma once
// Where the cloud is too coarse for a field: the indicator of Zienkiewicz and Zhu on the cells (paper 004,
// (80)-(82)).
#include "adapt/structure.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/machine/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::adapt {

struct Indicator {
  Field error;        ///< [cell] |e|_i = (∫_Ωi (f* − f_i)² dV)^½, unit of f times m^(dim/2)
  double total = 0.0; ///< |e| = (Σ |e|_i²)^½
  double norm = 0.0;  ///< ‖f‖ = (Σ f_i² V_i)^½
};

/// f*: interpolation of the nodal values, f_i: the constant that nodal integration has in the cell.
/// Integrated over the simplices between each node and the faces of its cell with dim + 1 points each, a rule
/// of degree 2 (Hammer, Marlowe, Stroud 1956): exactly zero for a constant, exact for a linear field.
///
/// make() gives the interpolation, one object a thread: evaluate(x, cell) at a point of the cell, then
/// nodes() and values(); false where there is none, which counts as the value of the cell.
template<int dim, class MakeFunctions>
Indicator indicator(const Cloud<dim>& cloud, const CellComplex<dim>& cells, const Field& value,
                    MakeFunctions&& make) {
  assert(value.size() == cells.cells() && cloud.position.size() == cells.cells());
  const double own = dim == 2 ? 4.0 : (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
  const double others = dim == 2 ? 1.0 : (5.0 - std::sqrt(5.0)) / 20.0;
  const double sum = dim == 2 ? 6.0 : 1.0;
  const CellLists<FaceIndex> faces = faces_of_cells(cells);
  const CellLists<PartIndex> parts = parts_of_cells(cells);
  Indicator result;
  result.error.assign(value.size(), 0.0);
  for_each_block(value.size(), [&](std::size_t begin, std::size_t end) {
    auto functions = make();
    const auto excess = [&](const Vec<dim>& x, std::size_t cell) {
      double e = 0.0;
      if (functions.evaluate(x, cell))
        for (std::size_t k = 0; k < functions.nodes().size(); ++k)
          e += functions.values()[k] * (value[index_of(functions.nodes()[k])] - value[cell]);
      return e;
    };
    /// ∫ (f* − f_i)² over the simplex between the node and a side, whose normal points out of the cell.
    const auto over = [&](std::size_t cell, const std::array<Vec<dim>, dim>& side) {
      std::array<Vec<dim>, dim + 1> corner;
      corner[0] = cloud.position[cell];
      std::copy(side.begin(), side.end(), corner.begin() + 1);
      const double volume = measure<dim>(corner);
      double squared = 0.0;
      for (std::size_t g = 0; g <= dim && volume != 0.0; ++g) {
        Vec<dim> x = own * corner[g];
        for (std::size_t k = 1; k <= dim; ++k) x += others * corner[(g + k) % (dim + 1)];
        x /= sum;
        const double e = excess(x, cell);
        squared += volume / (dim + 1) * e * e;
      }
      return squared;
    };
    for (std::size_t i = begin; i < end; ++i) {
      const auto around = cells.neighbours.of(i);
      if (std::all_of(around.begin(), around.end(),
                      [&](NodeIndex k) { return value[index_of(k)] == value[i]; }))
        continue;
      double squared = 0.0;
      for (const FaceIndex f : faces.of(i)) {
        const InnerFace<dim>& face = cells.interior[f];
        auto side = face.corner;
        if (index_of(face.cell[1]) == i) std::swap(side[0], side[1]);
        squared += over(i, side);
      }
      for (const PartIndex p : parts.of(i)) {
        const BoundaryPart<dim>& part = cells.boundary[p];
        const Facet<dim>& facet = cloud.facets[part.facet];
        // from a corner of the facet all its parts are seen edge-on
        if (std::find(facet.node.begin(), facet.node.end(), part.cell) == facet.node.end())
          squared += over(i, part.on(corners_of<dim>(facet, cloud.position)));
      }
      result.error[i] = std::sqrt(std::max(squared, 0.0));
    }
  });
  for (std::size_t i = 0; i < value.size(); ++i) {
    result.total += result.error[i] * result.error[i];
    result.norm += value[i] * value[i] * cells.volume[i];
  }
  result.total = std::sqrt(result.total);
  result.norm = std::sqrt(result.norm);
  return result;
}

/// With Sibson interpolation on Voronoi cells.
Indicator indicator(const Cloud<2>& cloud, const Structure& structure, const Field& value);

} // namespace cnem::adapt
