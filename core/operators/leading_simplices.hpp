#pragma once
// Rows of an operator that are linear simplices, before others that are means over several.
#include "core/index.hpp"
#include "core/operators/operators.hpp"

namespace cnem {

/// How many rows from the first on have dim + 1 nodes.
template<int dim> std::size_t leading_simplices(const DiscreteOperators<dim>& op) {
  std::size_t count = 0;
  while (count < index_of(op.points) && op.row_begin[count + 1] == (dim + 1) * (as<std::int32_t>(count) + 1))
    ++count;
  return count;
}

} // namespace cnem
