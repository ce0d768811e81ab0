#pragma once
// One vector out of a field that is stored by components.
#include "core/fields/aligned.hpp"
#include "core/index.hpp"
#include "core/vec.hpp"

namespace cnem {

/// The vector of node or point i; field [component][index].
template<int dim> Vec<dim> vector_at(const Fields<dim>& field, std::size_t i) {
  Vec<dim> vector;
  for (int k = 0; k < dim; ++k) vector[k] = field[index_of(k)][i];
  return vector;
}

} // namespace cnem
