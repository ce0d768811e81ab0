#pragma once
// Sparse operators as kernels read them: no standard containers (cmake/cnem.cmake, cnem_kernel).
#include <cstdint>

namespace cnem {

/// Rows (or columns) of an operator with dim weights an entry.
template<int dim> struct SparseRows {
  const std::int32_t* begin;
  const std::int32_t* index;
  const double* weight[dim];
};

} // namespace cnem
