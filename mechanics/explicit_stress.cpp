// Parts (ii) and (iii) of a step: stresses at points, forces at nodes.
#include "core/parallel.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>

namespace cnem {

namespace {

/// The parts of a field of records of `stride` numbers that belong to a range.
void fill(Field& field, std::size_t stride, const LevelRange& range, double value) {
  std::fill(field.begin() + static_cast<std::ptrdiff_t>(stride * range.begin),
            field.begin() + static_cast<std::ptrdiff_t>(stride * range.end), value);
}

} // namespace

template<int dim> plasticity::StressPoints<dim> ExplicitSolver<dim>::points_to_stress() {
  auto points = plasticity::stress_points(state_.point);
  if (damage_.active()) points.strength = damage_.flow_factor().data();
  return points;
}

/// Stresses of the points that are due, each over its own step; `dt` is the finest one, `before` the activity
/// that the last stresses were made at.
template<int dim> void ExplicitSolver<dim>::update_stress(int activity, int before, double dt) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const bool whole = activity == local_.highest();
  const bool links = edge_defect_.active(approximation_.links);
  const bool exchange = exchange_.active(approximation_.links);
  const auto stress_points = points_to_stress();
  const EdgePoints edge = links ? edge_defect_.points(shear_modulus_, point.plastic_strain) : EdgePoints{};
  if (exchange) exchange_.remember(point.pressure);
  if (!whole)
    for_each_range(local_.silenced(before), [&](const LevelRange& range) {
      fill(stress_.columns, dim * dim, range, 0.0);
      fill(stress_.out_of_plane, 1, range, 0.0);
    });
  const std::vector<LevelRange>& due = local_.points(activity);
  std::vector<std::ptrdiff_t> bad(due.size(), -1);
  std::vector<double> damping(due.size(), 0.0), released(due.size(), 0.0), heat(due.size(), 0.0);
  running_.viscosity += sum_ranges(due, [&](const LevelRange& range) {
    const auto [begin, end, level, marked] = range;
    const auto r = static_cast<std::size_t>(&range - due.data());
    const double own = dt * (1 << level);
    deformation_gradient<dim>(op, position_, point.deformation, begin, end);
    interpolate<dim>(op, node.temperature, point.temperature, begin, end);
    if (damage_.active()) damage_.weaken(point, begin, end);
    bad[r] =
        plasticity::update_stress(model_.materials, point.material, stress_points,
                                  static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end), own);
    if (damage_.active()) released[r] = damage_.update(op, model_.materials, point, begin, end, own);
    const ViscousSums viscous =
        add_bulk_viscosity<dim>(model_.viscosity, op, point, density_, wave_modulus_, own, jacobian_,
                                viscous_pressure_, flow_stress_, edge, stress_, begin, end);
    damping[r] = viscous.damping;
    if (links && !whole) edge_defect_.hold_moduli(begin, end);
    if (model_.thermal && !whole)
      for (std::size_t i = begin; i < end; ++i) {
        const plasticity::Material& material = material_of(i);
        const double q = material.taylor_quinney * point.dissipation[i] * node.mass[i] / material.density;
        node.temperature[i] += q / node.heat_capacity[i];
        heat[r] += q;
      }
    return viscous.dissipated;
  });
  for (const double energy : released) running_.damage += energy;
  for (const double q : heat) running_.heat_generated += q;
  for (const double ratio : damping) viscosity_ratio_ = std::max(viscosity_ratio_, ratio);
  for (const std::ptrdiff_t p : bad)
    if (p >= 0) diverged(static_cast<std::size_t>(p), "deformation gradient");
  if (!exchange) return;
  const auto energy = exchange_.apply(op, approximation_.links, reference_, dt, point, stress_);
  running_.pressure_exchange += energy.dissipated;
  plastic_offset_ += energy.plastic;
}

/// What points and loads give to the nodes that are kicked at an activity: each its force times the number of
/// finest steps in its own.
template<int dim> void ExplicitSolver<dim>::assemble_forces(int activity) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  const bool links = edge_defect_.active(approximation_.links), loaded = !model_.loads.empty();
  model_.loads.evaluate(state_.time, node.position, node.mass);
  if (op.nodal) {
    const std::vector<LevelRange>& due = local_.points(activity);
    std::vector<EdgeEnergy> energy(due.size());
    for_each_range(due, [&](const LevelRange& range) {
      const std::size_t begin = range.begin, end = range.end; // clang 14 captures no structured bindings
      const int level = range.level;
      for (Field& component : node.force) fill(component, 1, range, 0.0);
      if (links) {
        const auto apply = [&](const StabilisationLinks<dim>& part) {
          return edge_defect_.apply(part, op.volume, reference_, position_, stress_, node.force, begin, end);
        };
        EdgeEnergy& sum = energy[static_cast<std::size_t>(&range - due.data())];
        sum = apply(local_.own_links(approximation_.links));
        if (range.marked && activity > level) { // twice as heavy as seen from the other end
          const EdgeEnergy coarse = apply(local_.coarse_links());
          sum = {sum.stored + 0.5 * coarse.stored, sum.released + 0.5 * coarse.released};
        }
      }
      if (level == 0) return;
      const double steps = 1 << level;
      for (std::size_t c = dim * dim * begin; c < dim * dim * end; ++c) stress_.columns[c] *= steps;
      if constexpr (dim == 2)
        for (std::size_t p = begin; p < end; ++p) stress_.out_of_plane[p] *= steps;
      for (Field& component : node.force)
        for (std::size_t i = begin; i < end; ++i) component[i] *= steps;
    });
    if (links && activity == local_.highest()) {
      running_.stabilisation = 0.0;
      for (const EdgeEnergy& e : energy) {
        running_.stabilisation += e.stored;
        running_.penalty_release += e.released;
      }
    }
  }
  for_each_range(local_.kicked(activity), [&](const LevelRange& range) {
    const auto [begin, end, level, own_points_due] = range;
    const double steps = 1 << level;
    for (std::size_t k = 0; k < dim; ++k) {
      double* force = node.force[k].data();
      if (!own_points_due) fill(node.force[k], 1, range, 0.0);
      if (loaded)
        for (std::size_t i = begin; i < end; ++i) force[i] += steps * model_.loads.force()[k][i];
    }
    subtract_internal_force<dim>(op, stress_, node.force, begin, end);
  });
}

template plasticity::StressPoints<2> ExplicitSolver<2>::points_to_stress();
template void ExplicitSolver<2>::update_stress(int, int, double);
template void ExplicitSolver<2>::assemble_forces(int);

} // namespace cnem
