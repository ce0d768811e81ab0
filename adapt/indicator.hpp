#pragma once
// Where the cloud is too coarse for a field: the indicator of Zienkiewicz and Zhu on the cells (paper 004,
// (80)-(82)).
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/cloud.hpp"
#include "core/machine/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::adapt {

struct Indicator {
  Field error;        ///< [cell] |e|_i = (∫_Ωi (f* − f_i)² dV)^½, unit of f times m^(dim/2)
  double total = 0.0; ///< |e| = (Σ |e|_i²)^½
  double norm = 0.0;  ///< ‖f‖ = (Σ f_i² V_i)^½
};

/// f*: interpolation of the nodal values, f_i: the constant that nodal integration has in the cell, f* − f_i
/// taken to grow evenly from the node to the faces of its cell. Over a simplex between the two, of volume V,
/// ∫ (f* − f_i)² dV is then dim/(dim + 2) V times the mean of (f* − f_i)² on the face, for which each face is
/// looked at once for its two cells, with a rule of degree 2: exactly zero for a constant, exact for a linear
/// field.
///
/// make() gives the interpolation, one object a thread: evaluate(x, face) at a point of a face, evaluate(x,
/// cell) at one of the boundary of a cell, then nodes() and values(); false where there is none, which counts
/// as the value of the cell.
template<int dim, class MakeFunctions>
Indicator indicator(const Cloud<dim>& cloud, const CellComplex<dim>& cells, const Field& value,
                    MakeFunctions&& make) {
  assert(value.size() == cells.cells() && cloud.position.size() == cells.cells());
  constexpr double growing = static_cast<double>(dim) / (dim + 2);
  const auto rule = face_rule<dim>(2);
  const CellLists<FaceIndex> faces = faces_of_cells(cells);
  const CellLists<PartIndex> parts = parts_of_cells(cells);
  std::vector<char> flat(value.size());
  for_each_block(value.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto around = cells.neighbours.of(i);
      flat[i] = std::all_of(around.begin(), around.end(),
                            [&](NodeIndex k) { return value[index_of(k)] == value[i]; });
    }
  });
  const auto excess = [&](const auto& functions, std::size_t cell) {
    double e = 0.0;
    for (std::size_t k = 0; k < functions.nodes().size(); ++k)
      e += functions.values()[k] * (value[index_of(functions.nodes()[k])] - value[cell]);
    return e;
  };
  /// Of the simplex between a node and one side of its cell, whose normal points out of it.
  const auto volume = [&](std::size_t cell, const std::array<Vec<dim>, dim>& side) {
    std::array<Vec<dim>, dim + 1> corner;
    corner[0] = cloud.position[cell];
    std::copy(side.begin(), side.end(), corner.begin() + 1);
    return measure<dim>(corner);
  };
  IndexedVector<FaceIndex, std::array<double, 2>> over(cells.interior.size(), {0.0, 0.0});
  for_each_block(over.size(), [&](std::size_t begin, std::size_t end) {
    auto functions = make();
    for (std::size_t f = begin; f < end; ++f) {
      const InnerFace<dim>& face = cells.interior[f];
      const std::size_t i = index_of(face.cell[0]), j = index_of(face.cell[1]);
      if ((flat[i] && flat[j]) || face.normal().squaredNorm() == 0.0) continue;
      for (const FacePoint<dim>& point : rule) {
        if (!functions.evaluate(point_on<dim>(face.corner, point.place), face)) continue;
        const double at_i = excess(functions, i), at_j = excess(functions, j);
        over[f][0] += point.weight * at_i * at_i;
        over[f][1] += point.weight * at_j * at_j;
      }
    }
  });
  Indicator result;
  result.error.assign(value.size(), 0.0);
  for_each_block(value.size(), [&](std::size_t begin, std::size_t end) {
    auto functions = make();
    for (std::size_t i = begin; i < end; ++i) {
      if (flat[i]) continue;
      double squared = 0.0;
      for (const FaceIndex f : faces.of(i)) {
        const InnerFace<dim>& face = cells.interior[f];
        const bool second = index_of(face.cell[1]) == i;
        auto side = face.corner;
        if (second) std::swap(side[0], side[1]);
        squared += growing * volume(i, side) * over[f][second ? 1 : 0];
      }
      for (const PartIndex p : parts.of(i)) {
        const BoundaryPart<dim>& part = cells.boundary[p];
        const Facet<dim>& facet = cloud.facets[part.facet];
        // from a corner of the facet all its parts are seen edge-on
        if (std::find(facet.node.begin(), facet.node.end(), part.cell) != facet.node.end()) continue;
        const auto side = part.on(corners_of<dim>(facet, cloud.position));
        for (const FacePoint<dim>& point : rule) {
          if (!functions.evaluate(point_on<dim>(side, point.place), i)) continue;
          const double e = excess(functions, i);
          squared += growing * volume(i, side) * point.weight * e * e;
        }
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

} // namespace cnem::adapt
