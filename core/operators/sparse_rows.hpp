#pragma once
// Sparse operators as kernels read them: no standard containers (cmake/cnem.cmake, cnem_kernel).
#include "core/index_kinds.hpp"

namespace cnem {

/// Numbers that a vector takes where components lie side by side (core/operators/side_by_side.hpp): in space
/// a fourth, so that a neighbour is one register in one cache line.
template<int dim> inline constexpr int beside = dim == 2 ? 2 : 4;

/// Rows or columns of an operator with dim weights an entry, and what stands at the other side of each entry.
template<int dim, class Index> struct SparseRows {
  const std::int32_t* begin;
  const Index* index;
  const double* weight[dim];
};
template<int dim> using OperatorRows = SparseRows<dim, NodeIndex>;
template<int dim> using OperatorColumns = SparseRows<dim, PointIndex>;

} // namespace cnem
