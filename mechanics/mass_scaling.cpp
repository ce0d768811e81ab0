#include "mechanics/mass_scaling.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {
namespace {

/// Norm of entry e of a gradient, with that of the hoop row of a body of revolution
/// (mechanics/stable_step.hpp).
template<int dim> double block_norm(const Fields<dim>& gradient, const Field& hoop, std::size_t e) {
  double square = 0.0;
  for (std::size_t k = 0; k < dim; ++k) square += gradient[k][e] * gradient[k][e];
  if (!hoop.empty()) square += hoop[e] * hoop[e] + std::max(0.0, 2.0 * hoop[e] * gradient[0][e]);
  return std::sqrt(square);
}

template<class Number> std::size_t at(const std::vector<Number>& list, std::size_t i) {
  return index_of(list[i]);
}

} // namespace

template<int dim>
Field scales_for_frequency(const DiscreteOperators<dim>& operators, const Field& wave_modulus,
                           const Field& mass, double most) {
  const auto points = index_of(operators.points);
  Field transfer(mass.size(), 0.0), scale(mass.size(), 1.0);
  for (std::size_t j = 0; j < mass.size(); ++j) {
    for (std::size_t e = at(operators.col_begin, j); e < at(operators.col_begin, j + 1); ++e)
      transfer[j] += block_norm<dim>(operators.weighted_gradient, operators.weighted_hoop, e);
    transfer[j] /= mass[j];
  }
  for (std::size_t p = 0; p < points; ++p) {
    double sum = 0.0;
    for (std::size_t e = at(operators.row_begin, p); e < at(operators.row_begin, p + 1); ++e)
      sum += block_norm<dim>(operators.gradient, operators.hoop, e) * transfer[at(operators.node, e)];
    const double excess = wave_modulus[p] * sum / most;
    for (std::size_t e = at(operators.row_begin, p); e < at(operators.row_begin, p + 1); ++e) {
      double& own = scale[at(operators.node, e)];
      own = std::max(own, excess);
    }
  }
  return scale;
}

template Field scales_for_frequency<2>(const DiscreteOperators<2>&, const Field&, const Field&, double);
template Field scales_for_frequency<3>(const DiscreteOperators<3>&, const Field&, const Field&, double);

} // namespace cnem
