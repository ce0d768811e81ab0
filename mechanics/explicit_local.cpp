// The explicit step with local time steps: one macro step in which points and nodes are due at the rate of
// their level (docs/theory.md, "Local time steps").
#include "core/error.hpp"
#include "mechanics/explicit_solver.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

template<int dim> int ExplicitSolver<dim>::sub_steps() const {
  if (!local_.on() || next_levels_.empty()) return local_.on() ? local_.sub_steps() : 1;
  return 1 << *std::max_element(next_levels_.begin(), next_levels_.end());
}

template<int dim> double ExplicitSolver<dim>::updates() const {
  return local_.on() ? local_.updates() : static_cast<double>(state_.node.size());
}

template<int dim> double ExplicitSolver<dim>::load_weight(std::size_t node) const {
  if (!local_.on()) return 1.0;
  return start_load_weight_.empty() ? local_.weight(node) : start_load_weight_[node / LocalSteps<dim>::block];
}

template<int dim> void ExplicitSolver<dim>::take_levels(typename LocalSteps<dim>::Levels level) {
  std::vector<bool> finest(state_.node.size(), false);
  if (model_.contact.active() || !model_.loads.empty())
    for (const Facet<dim>& facet : model_.cloud.facets)
      for (const std::int32_t i : facet.node) finest[static_cast<std::size_t>(i)] = true;
  for (const auto& held : model_.supports.prescribed()) finest[static_cast<std::size_t>(held.node)] = true;
  for (const std::int32_t i : model_.ties.nodes()) finest[static_cast<std::size_t>(i)] = true;
  local_.take(std::move(level), approximation_.mechanics, approximation_.links, finest);
  window_.clear();
  if (!model_.contact.flow_stress_needed()) return;
  for (int a = 0; a <= local_.highest(); ++a) {
    std::vector<double>& window = window_.emplace_back();
    for (const std::int32_t i : model_.contact.boundary_nodes())
      window.push_back(local_.window(approximation_.mechanics, static_cast<std::size_t>(i), a));
  }
}

/// The levels in use on new operators, with the impulses they make there; what the new neighbourhoods ask for
/// comes with the next step.
template<int dim> void ExplicitSolver<dim>::rebuild_levels() {
  if (!approximation_.mechanics.nodal) throw InputError("local time steps need stress points at nodes");
  if (damage_.active()) throw InputError("local time steps do not take damage laws");
  take_levels(local_.level());
  next_levels_ = local_.level();
  LocalSteps<dim>::grade(approximation_.mechanics, approximation_.links, next_levels_);
  if (next_levels_ == local_.level()) next_levels_.clear();
  on_new_reference_ = true;
  local_.look_again();
  assemble_impulses(local_.highest());
}

/// Stresses of all points as they were before impulses were made of them.
template<int dim> void ExplicitSolver<dim>::restore_columns() {
  const PointState<dim>& point = state_.point;
  const auto& f = point.deformation;
  take_columns<dim>(point.piola, stress_);
  if (!on_new_reference_) {
    static_assert(dim == 2, "cofactors of the plane");
    for (std::size_t p = 0; p < point.size(); ++p) {
      const double q = viscous_pressure_[p];
      const double cofactor[4] = {f[3][p], -f[1][p], -f[2][p], f[0][p]}; // by columns
      for (std::size_t c = 0; c < 4; ++c) stress_.columns[4 * p + c] -= q * (cofactor[c] * f[4][p]);
      stress_.out_of_plane[p] -= q * (f[0][p] * f[3][p] - f[1][p] * f[2][p]);
    }
  }
  if (edge_defect_.active(approximation_.links)) edge_defect_.take(point.deformation, 0, point.size());
}

/// Between two macro steps each point gives half its impulse with the step it made and half with the one it
/// is about to make: `finest` (s) is the finest of those.
template<int dim> void ExplicitSolver<dim>::change_levels(double finest) {
  NodeState<dim>& node = state_.node;
  const double stored = running_.stabilisation, released = running_.penalty_release;
  const Fields<dim> made = node.force;
  const std::size_t blocks = next_levels_.size();
  std::vector<double> weight(blocks);
  for (std::size_t b = 0; b < blocks; ++b) weight[b] = local_.weight(b * LocalSteps<dim>::block);
  restore_columns();
  take_levels(std::move(next_levels_));
  next_levels_.clear();
  assemble_impulses(local_.highest());
  running_.stabilisation = stored;
  running_.penalty_release = released;
  if (finest_before_ == 0.0) return;
  const double was = finest_before_ / (finest_before_ + finest), is = finest / (finest_before_ + finest);
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < node.size(); ++i) node.force[k][i] = was * made[k][i] + is * node.force[k][i];
  for (std::size_t b = 0; b < blocks; ++b)
    weight[b] = was * weight[b] + is * local_.weight(b * LocalSteps<dim>::block);
  start_load_weight_ = std::move(weight);
}

template<int dim> typename ExplicitSolver<dim>::Step ExplicitSolver<dim>::stable_macro_step() {
  const double stabilisation = edge_defect_.active(approximation_.links) ? model_.stabilisation : 0.0;
  const auto bounds = bound_.evaluate_ranges(approximation_.mechanics, state_.point.deformation,
                                             wave_modulus_, state_.node.mass, LocalSteps<dim>::block);
  Field stable(bounds.size());
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    stable[b] = stable_wave_step(bounds[b].value, stabilisation, viscosity_ratio_);
    if (!(stable[b] > 0.0)) diverged(bounds[b].point, "stable step");
  }
  auto choice = local_.choose(approximation_.mechanics, approximation_.links, stable);
  next_levels_.clear();
  if (choice.level != local_.level()) next_levels_ = std::move(choice.level);
  return {model_.safety * sub_steps() * choice.finest, bounds[choice.limit].point, "elastic waves"};
}

template<int dim> void ExplicitSolver<dim>::advance_by_levels(double dt) {
  const double start = state_.time;
  const double step = dt / sub_steps();
  if (!next_levels_.empty()) change_levels(step);
  const int count = local_.sub_steps();
  const double first = 0.5 * (finest_before_ + step), duration = first + (count - 1) * step;
  const bool several = count > 1 && model_.contact.active();
  if (several) model_.contact.begin_sub_steps();
  auto reactions = model_.supports.reactions();
  for (auto& reaction : reactions) reaction.setZero();
  viscosity_ratio_ = 0.0;
  int activity = local_.highest();
  for (int s = 1; s <= count; ++s) {
    const int before = activity;
    const double dt_mean = s == 1 ? first : step;
    move_due(activity, step, dt_mean);
    for (std::size_t i = 0; i < reactions.size(); ++i)
      reactions[i] += dt_mean / duration * model_.supports.reactions()[i];
    activity = local_.activity(s);
    strain_and_stress_due(activity, before, step);
    state_.time = start + s * step;
    if (s == count) ++state_.step;
    assemble_impulses(activity);
  }
  if (several) model_.contact.end_sub_steps(duration);
  if (count > 1) model_.supports.report(std::move(reactions));
  state_.step_before = dt;
  finest_before_ = step;
  on_new_reference_ = false;
  take_contact_heat();
  if (!model_.thermal) return;
  heat_plastically();
  conduct(dt);
}

/// The nodes that are due move by their own step; `dt` is the finest one.
template<int dim> void ExplicitSolver<dim>::move_due(int activity, double dt, double dt_mean) {
  NodeState<dim>& node = state_.node;
  const std::vector<LevelRange>& due = local_.moved(activity);
  model_.contact.remember(node.velocity);
  for_each_range(due, [&](const LevelRange& range) {
    for (std::size_t k = 0; k < dim; ++k) {
      for (std::size_t i = range.begin; i < range.end; ++i) velocity_before_[k][i] = node.velocity[k][i];
      if (!range.marked) continue;
      for (std::size_t i = range.begin; i < range.end; ++i)
        node.velocity[k][i] = velocity_before_[k][i] + dt_mean * node.force[k][i] / node.mass[i];
    }
  });
  if (!model_.ties.empty())
    for (Field& component : node.velocity) model_.ties.share(node.mass, component);
  model_.supports.apply(state_.time, dt, dt_mean, node.mass, velocity_before_, node.velocity);
  running_.supports = model_.supports.work();
  for_each_range(due, [&](const LevelRange& range) {
    const double own = dt * (1 << range.level);
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = range.begin; i < range.end; ++i) node.position[k][i] += own * node.velocity[k][i];
  });

  if (window_.empty())
    correct_contact(dt, dt_mean);
  else
    correct_contact(dt, dt_mean, window_[static_cast<std::size_t>(activity)]);
  if (!model_.ties.empty())
    tie_loss_ += model_.ties.share_motion(node.mass, dt, node.velocity, node.position);
  for_each_range(due, [&](const LevelRange& range) {
    place_side_by_side<dim>(node.position, position_, range.begin, range.end);
  });

  if (!model_.loads.empty()) {
    const Fields<dim>& f = model_.loads.force();
    running_.loads += sum_ranges(local_.kicked(activity), [&](const LevelRange& range) {
      double sum = 0.0;
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = range.begin; i < range.end; ++i)
          sum += 0.5 * dt_mean * load_weight(i) * f[k][i] * (velocity_before_[k][i] + node.velocity[k][i]);
      return sum;
    });
  }
  start_load_weight_.clear();
}

/// Stresses of the points that are due, each over its own step; `dt` is the finest one, `before` the activity
/// that the last stresses were made at.
template<int dim> void ExplicitSolver<dim>::strain_and_stress_due(int activity, int before, double dt) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const bool whole = activity == local_.highest();
  const bool links = edge_defect_.active(approximation_.links);
  const auto stress_points = plasticity::stress_points(point);
  const EdgePoints edge = links ? edge_defect_.points(shear_modulus_, point.plastic_strain) : EdgePoints{};
  if (!whole)
    for_each_range(local_.silenced(before), [&](const LevelRange& range) {
      const auto columns = stress_.columns.begin();
      std::fill(columns + static_cast<std::ptrdiff_t>(dim * dim * range.begin),
                columns + static_cast<std::ptrdiff_t>(dim * dim * range.end), 0.0);
      std::fill(stress_.out_of_plane.begin() + static_cast<std::ptrdiff_t>(range.begin),
                stress_.out_of_plane.begin() + static_cast<std::ptrdiff_t>(range.end), 0.0);
    });
  const std::vector<LevelRange>& due = local_.points(activity);
  std::vector<std::ptrdiff_t> bad(due.size(), -1);
  std::vector<double> damping(due.size(), 0.0), heat(due.size(), 0.0);
  running_.viscosity += sum_ranges(due, [&](const LevelRange& range) {
    const auto [begin, end, level, marked] = range;
    const auto r = static_cast<std::size_t>(&range - due.data());
    const double own = dt * (1 << level);
    deformation_gradient<dim>(op, position_, point.deformation, begin, end);
    interpolate<dim>(op, node.temperature, point.temperature, begin, end);
    bad[r] =
        plasticity::update_stress(model_.materials, point.material, stress_points,
                                  static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end), own);
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
  for (const double q : heat) running_.heat_generated += q;
  for (const double ratio : damping) viscosity_ratio_ = std::max(viscosity_ratio_, ratio);
  for (const std::ptrdiff_t p : bad)
    if (p >= 0) diverged(static_cast<std::size_t>(p), "deformation gradient");
}

/// What the points that are due give to nodes, in place of forces: each over the number of finest steps in
/// its own.
template<int dim> void ExplicitSolver<dim>::assemble_impulses(int activity) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  const std::vector<LevelRange>& due = local_.points(activity);
  const bool links = edge_defect_.active(approximation_.links), loaded = !model_.loads.empty();
  model_.loads.evaluate(state_.time, node.position, node.mass);
  std::vector<EdgeEnergy> energy(due.size());
  for_each_range(due, [&](const LevelRange& range) {
    const std::size_t begin = range.begin, end = range.end; // clang 14 captures no structured bindings
    const int level = range.level;
    for (Field& component : node.force)
      std::fill(component.begin() + static_cast<std::ptrdiff_t>(begin),
                component.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
    if (links) {
      const auto apply = [&](const StabilisationLinks<dim>& part) {
        return edge_defect_.apply(part, op.volume, reference_, position_, stress_, node.force, begin, end);
      };
      EdgeEnergy& sum = energy[static_cast<std::size_t>(&range - due.data())];
      sum = apply(local_.own_links());
      if (range.marked && activity > level) { // twice as heavy as seen from the other end
        const EdgeEnergy coarse = apply(local_.coarse_links());
        sum = {sum.stored + 0.5 * coarse.stored, sum.released + 0.5 * coarse.released};
      }
    }
    if (level == 0) return;
    const double steps = 1 << level;
    for (std::size_t c = dim * dim * begin; c < dim * dim * end; ++c) stress_.columns[c] *= steps;
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
  for_each_range(local_.kicked(activity), [&](const LevelRange& range) {
    const auto [begin, end, level, own_points_due] = range;
    const double steps = 1 << level;
    for (std::size_t k = 0; k < dim; ++k) {
      double* force = node.force[k].data();
      if (!own_points_due) std::fill(force + begin, force + end, 0.0);
      if (loaded)
        for (std::size_t i = begin; i < end; ++i) force[i] += steps * model_.loads.force()[k][i];
    }
    subtract_internal_force<dim>(op, stress_, node.force, begin, end);
  });
}

template int ExplicitSolver<2>::sub_steps() const;
template double ExplicitSolver<2>::updates() const;
template double ExplicitSolver<2>::load_weight(std::size_t) const;
template void ExplicitSolver<2>::take_levels(LocalSteps<2>::Levels);
template void ExplicitSolver<2>::rebuild_levels();
template void ExplicitSolver<2>::restore_columns();
template void ExplicitSolver<2>::change_levels(double);
template ExplicitSolver<2>::Step ExplicitSolver<2>::stable_macro_step();
template void ExplicitSolver<2>::move_due(int, double, double);
template void ExplicitSolver<2>::strain_and_stress_due(int, int, double);
template void ExplicitSolver<2>::assemble_impulses(int);
template void ExplicitSolver<2>::advance_by_levels(double);

} // namespace cnem
