#pragma once
// Sums over masses, in the plane and in space.
#include "core/fields/vector_at.hpp"

namespace cnem::contact::testing {

/// kg m/s (times m^(dim−3)).
template<int dim> Vec<dim> momentum_of(const Field& mass, const Fields<dim>& velocity) {
  Vec<dim> sum = Vec<dim>::Zero();
  for (std::size_t i = 0; i < mass.size(); ++i) sum += mass[i] * vector_at<dim>(velocity, i);
  return sum;
}

/// J (times m^(dim−3)).
template<int dim> double kinetic_of(const Field& mass, const Fields<dim>& velocity) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    sum += 0.5 * mass[i] * vector_at<dim>(velocity, i).squaredNorm();
  return sum;
}

} // namespace cnem::contact::testing
