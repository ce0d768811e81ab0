#pragma once
// Sparse operators as kernels read them: no standard containers (cmake/cnem.cmake, cnem_kernel).
#include "core/index_kinds.hpp"

namespace cnem {

/// Rows or columns of an operator with dim weights an entry, and what stands at the other side of each entry.
template<int dim, class Index> struct SparseRows {
  const std::int32_t* begin;
  const Index* index;
  const double* weight[dim];
};
template<int dim> using OperatorRows = SparseRows<dim, NodeIndex>;
template<int dim> using OperatorColumns = SparseRows<dim, PointIndex>;

} // namespace cnem
