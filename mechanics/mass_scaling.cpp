#include "mechanics/mass_scaling.hpp"

#include "core/index.hpp"
#include "mechanics/stable_step.hpp"

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

/// The rows of the bound (x = 1), 1/s².
template<int dim>
Field bound_rows(const DiscreteOperators<dim>& operators, const Field& wave_modulus, const Field& mass) {
  Field transfer(mass.size(), 0.0), row(index_of(operators.points));
  for (std::size_t j = 0; j < mass.size(); ++j) {
    for (std::size_t e = index_of(operators.col_begin[j]); e < index_of(operators.col_begin[j + 1]); ++e)
      transfer[j] += block_norm<dim>(operators.weighted_gradient, operators.weighted_hoop, e);
    transfer[j] /= mass[j];
  }
  for (std::size_t p = 0; p < row.size(); ++p) {
    double sum = 0.0;
    for (std::size_t e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e)
      sum += block_norm<dim>(operators.gradient, operators.hoop, e) * transfer[index_of(operators.node[e])];
    row[p] = wave_modulus[p] * sum;
  }
  return row;
}

/// Factors that bring every row to `most` or below: each node takes the largest excess of the stress points
/// it belongs to.
template<int dim>
Field scales_for_rows(const DiscreteOperators<dim>& operators, const Field& row, double most) {
  Field scale(index_of(operators.nodes), 1.0);
  for (std::size_t p = 0; p < row.size(); ++p) {
    const double excess = row[p] / most;
    if (!(excess > 1.0)) continue;
    for (std::size_t e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e) {
      double& own = scale[index_of(operators.node[e])];
      own = std::max(own, excess);
    }
  }
  return scale;
}

} // namespace

template<int dim>
Field scales_for_frequency(const DiscreteOperators<dim>& operators,
                           const Fields<tensor_size<dim>>& deformation, const Field& wave_modulus,
                           const Field& mass, double most, int rounds) {
  // Rows are above the bound: they may stay above `most` by as much as the bound with scaled masses allows.
  const auto bound = [&](const Field& factor) {
    Field scaled = mass;
    for (std::size_t i = 0; i < mass.size(); ++i) scaled[i] *= factor[i];
    return SpectralBound<dim>().of_all(operators, deformation, wave_modulus, scaled).value;
  };
  const Field row = bound_rows(operators, wave_modulus, mass);
  Field scale = scales_for_rows(operators, row, most);
  double rows = most * (most / bound(scale));
  if (rounds == 0) return scales_for_rows(operators, row, rows);
  for (int round = 0; round < rounds; ++round) {
    Field lighter = scales_for_rows(operators, row, rows);
    if (!(bound(lighter) <= most)) break;
    scale = std::move(lighter);
    rows *= most / bound(scale);
  }
  return scale;
}

template Field scales_for_frequency<2>(const DiscreteOperators<2>&, const Fields<5>&, const Field&,
                                       const Field&, double, int);
template Field scales_for_frequency<3>(const DiscreteOperators<3>&, const Fields<9>&, const Field&,
                                       const Field&, double, int);

} // namespace cnem
