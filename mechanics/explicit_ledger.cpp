// What a run of the explicit solver is audited by: energies, mass, strain since the last reference.
#include "core/parallel.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

template<int dim> double ExplicitSolver<dim>::energy_over_body(const Field& density) const {
  const Field& volume = approximation_.mechanics.volume;
  const Field& stress_free = state_.point.stress_free;
  return sum_blocks(volume.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t p = begin; p < end; ++p) sum += volume[p] * stress_free[p] * density[p];
    return sum;
  });
}

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

/// Of v_n = v_{n−½} + ½ Δt f_n/m, to first order in Δt.
template<int dim> double ExplicitSolver<dim>::kinetic_energy() const {
  const NodeState<dim>& node = state_.node;
  const double half = 0.5 * finest_before_;
  const Field& mass = inertia();
  return sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i) {
        const double v = node.velocity[k][i];
        sum += 0.5 * mass[i] * v * v + half * v * node.force[k][i];
      }
    return sum;
  });
}

template<int dim> EnergyLedger ExplicitSolver<dim>::ledger() const {
  const NodeState<dim>& node = state_.node;
  const PointState<dim>& point = state_.point;
  EnergyLedger ledger = running_;
  const double half = 0.5 * finest_before_;
  const Fields<dim>& load = model_.loads.force();
  const Field& mass = inertia();
  ledger.kinetic = kinetic_energy();
  ledger.inertial = sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i)
        sum += 0.5 * mass[i] * node.velocity[k][i] * node.velocity[k][i];
    return sum;
  });
  if (!model_.loads.empty())
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = 0; i < node.size(); ++i)
        ledger.loads += half * load_weight(i) * node.velocity[k][i] * load[k][i];
  const contact::DriveEnergy drives = model_.contact.drive_energy();
  ledger.tool_kinetic = drives.kinetic;
  ledger.drives = drives.work;
  ledger.elastic = energy_over_body(point.stored_energy);
  ledger.plastic = plastic_offset_ + energy_over_body(point.plastic_work);
  for (std::size_t i = 0; i < node.size(); ++i)
    ledger.heat_content += node.heat_capacity[i] * (node.temperature[i] - initial_temperature_[i]);
  return ledger;
}

template<int dim> std::array<double, 2> ExplicitSolver<dim>::mass_balance() const {
  std::array<double, 2> range{1.0, 1.0};
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  if (!op.nodal) return range;
  for (std::size_t i = 0; i < state_.node.size(); ++i) {
    const double r =
        material_of(i).density * op.volume[i] * state_.point.stress_free[i] / state_.node.mass[i];
    range = {std::min(range[0], r), std::max(range[1], r)};
  }
  return range;
}

template double ExplicitSolver<2>::energy_over_body(const Field&) const;
template double ExplicitSolver<2>::kinetic_energy() const;
template double ExplicitSolver<2>::strain_since_reference() const;
template EnergyLedger ExplicitSolver<2>::ledger() const;
template std::array<double, 2> ExplicitSolver<2>::mass_balance() const;

} // namespace cnem
