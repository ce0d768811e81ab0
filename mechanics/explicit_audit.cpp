// What a run of the explicit solver is audited by: energies, mass, strain since the last reference.
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

template<int dim> double ExplicitSolver<dim>::strain_since_reference() const {
  const auto& f = state_.point.deformation;
  return max_blocks(state_.point.size(),
                    [&](std::size_t begin, std::size_t end) {
                      BlockMaximum best{0.0, begin};
                      for (std::size_t p = begin; p < end; ++p) {
                        double sum = 0.0;
                        for (std::size_t i = 0; i < dim; ++i)
                          for (std::size_t k = 0; k < dim; ++k) {
                            const double d = f[i * dim + k][p] - (i == k ? 1.0 : 0.0);
                            sum += d * d;
                          }
                        if constexpr (dim == 2) sum += (f[4][p] - 1.0) * (f[4][p] - 1.0);
                        if (sum > best.value) best = {sum, p};
                      }
                      best.value = std::sqrt(best.value);
                      return best;
                    })
      .value;
}

template<int dim> EnergyLedger ExplicitSolver<dim>::ledger() const {
  std::vector<Energy> entries;
  each([&](Term<dim>& term) {
    term.audit(body());
    for (const Energy* energy : term.energies()) entries.push_back(*energy);
  });
  return {std::move(entries), initial_energy_};
}

template<int dim> std::vector<Metric> ExplicitSolver<dim>::metrics() const {
  std::vector<Metric> metrics;
  each([&](Term<dim>& term) {
    for (Metric& metric : term.metrics(body())) metrics.push_back(std::move(metric));
  });
  return metrics;
}

template<int dim> double ExplicitSolver<dim>::volume_ratio(std::size_t node) const {
  const DiscreteOperators<dim>& op = approximation_->mechanics;
  const Field& stress_free = state_.point.stress_free;
  if (op.nodal)
    return body().material_of(node).density * op.volume[node] * stress_free[node] / state_.node.mass[node];
  if (references_ == 1) return 1.0; // that of its points
  double share = 0.0;
  for (auto e = index_of(op.col_begin[node]); e < index_of(op.col_begin[node + 1]); ++e) {
    const auto p = index_of(op.point[e]);
    share += body().material_of(p).density * op.weighted_value[e] * stress_free[p];
  }
  return share / state_.node.mass[node];
}

template<int dim> std::array<double, 2> ExplicitSolver<dim>::mass_balance() const {
  std::array<double, 2> range{1.0, 1.0};
  for (std::size_t i = 0; i < state_.node.size(); ++i) {
    const double r = volume_ratio(i);
    range = {std::min(range[0], r), std::max(range[1], r)};
  }
  return range;
}

template double ExplicitSolver<2>::strain_since_reference() const;
template double ExplicitSolver<3>::strain_since_reference() const;
template EnergyLedger ExplicitSolver<2>::ledger() const;
template EnergyLedger ExplicitSolver<3>::ledger() const;
template std::vector<Metric> ExplicitSolver<2>::metrics() const;
template std::vector<Metric> ExplicitSolver<3>::metrics() const;
template double ExplicitSolver<2>::volume_ratio(std::size_t) const;
template double ExplicitSolver<3>::volume_ratio(std::size_t) const;
template std::array<double, 2> ExplicitSolver<2>::mass_balance() const;
template std::array<double, 2> ExplicitSolver<3>::mass_balance() const;

} // namespace cnem
