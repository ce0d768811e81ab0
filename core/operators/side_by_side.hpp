#pragma once
// Vector fields with their components side by side, [node · beside<dim> + component], in space followed by a
// zero: what passes that gather over neighbours read, so that a neighbour costs one cache line.
#include "core/fields/aligned.hpp"
#include "core/operators/sparse_rows.hpp"

#include <cstdint>

namespace cnem {

/// An operator as kernels read it.
template<int dim, class Index>
SparseRows<dim, Index> sparse_rows(const std::vector<std::int32_t>& begin, const std::vector<Index>& index,
                                   const Fields<dim>& weight) {
  SparseRows<dim, Index> rows{begin.data(), index.data(), {}};
  for (std::size_t k = 0; k < dim; ++k) rows.weight[k] = weight[k].data();
  return rows;
}

/// Copies the nodes [begin, end).
template<int dim>
void place_side_by_side(const Fields<dim>& field, Field& side_by_side, std::size_t begin, std::size_t end) {
  const auto from = pointers(field);
  double* to = side_by_side.data();
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t k = 0; k < dim; ++k) to[i * beside<dim> + k] = from[k][i];
}

template<int dim> Field side_by_side(const Fields<dim>& field) {
  Field result(beside<dim> * field[0].size());
  place_side_by_side<dim>(field, result, 0, field[0].size());
  return result;
}

} // namespace cnem
