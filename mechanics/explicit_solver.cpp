#include "mechanics/explicit_solver.hpp"

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem {

template<int dim> plasticity::StressPoints<dim> ExplicitSolver<dim>::points_to_stress() {
  auto points = plasticity::stress_points(state_.point);
  if (damage_.active()) points.strength = damage_.flow_factor().data();
  return points;
}

template<int dim> void ExplicitSolver<dim>::advance(double dt) {
  if (local_.on()) return advance_by_levels(dt);
  const double dt_mean = 0.5 * (state_.step_before + dt);
  double lap = wall_time();
  const auto take = [&](double& part) {
    const double now = wall_time();
    part += now - std::exchange(lap, now);
  };
  if (model_.mechanical) {
    accelerate_and_move(dt, dt_mean); // (i)   (54), (55), corrected by supports and contact
    take(times_.motion);
    strain_and_stress(dt); // (ii)  Box 2
    take(times_.stress);
  }
  state_.time += dt;
  state_.step_before = dt;
  ++state_.step;
  if (model_.mechanical) assemble_forces(); // (iii) (52), (53)
  take(times_.forces);
  if (model_.thermal) {
    heat_plastically();
    conduct(dt); // (58), staggered
  }
  take(times_.heat);
}

template<int dim> void ExplicitSolver<dim>::accelerate_and_move(double dt, double dt_mean) {
  NodeState<dim>& node = state_.node;
  const Field& inertia = this->inertia();
  model_.contact.remember(node.velocity);
  std::swap(velocity_before_, node.velocity);
  for_each_block(node.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i)
        node.velocity[k][i] = velocity_before_[k][i] + dt_mean * node.force[k][i] / inertia[i];
  });
  if (!model_.ties.empty())
    for (Field& component : node.velocity) model_.ties.share(inertia, component);
  model_.supports.apply(state_.time, dt, dt_mean, inertia, velocity_before_, node.velocity);
  running_.supports = model_.supports.work();
  for_each_block(node.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = begin; i < end; ++i) node.position[k][i] += dt * node.velocity[k][i];
  });

  const double start = wall_time();
  correct_contact(dt, dt_mean);
  take_contact_heat();
  const double contact = wall_time() - start;
  times_.contact += contact;
  times_.motion -= contact; // whoever times the whole motion counts it too
  if (!model_.ties.empty()) tie_loss_ += model_.ties.share_motion(inertia, dt, node.velocity, node.position);

  for_each_block(node.size(), [&](std::size_t begin, std::size_t end) {
    place_side_by_side<dim>(node.position, position_, begin, end);
  });

  if (!model_.loads.empty()) {
    const Fields<dim>& f = model_.loads.force();
    running_.loads += sum_blocks(node.size(), [&](std::size_t begin, std::size_t end) {
      double sum = 0.0;
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = begin; i < end; ++i)
          sum += 0.5 * dt_mean * f[k][i] * (velocity_before_[k][i] + node.velocity[k][i]);
      return sum;
    });
  }
}

template<int dim>
void ExplicitSolver<dim>::correct_contact(double dt, double dt_mean, std::span<const double> window) {
  contact::RigidContact<dim>& contact = model_.contact;
  if (!contact.active()) return;
  NodeState<dim>& node = state_.node;
  const std::vector<std::int32_t>& boundary = contact.boundary_nodes();
  std::vector<double> flow_stress;
  if (contact.flow_stress_needed()) {
    flow_stress.reserve(boundary.size());
    for (const std::int32_t i : boundary)
      flow_stress.push_back(
          average_at_node<dim>(approximation_.mechanics, flow_stress_, static_cast<std::size_t>(i)));
  }
  std::vector<double> effusivity;
  if (model_.thermal)
    for (const std::int32_t i : boundary) {
      const plasticity::Material& material = material_of_node(static_cast<std::size_t>(i));
      effusivity.push_back(std::sqrt(material.conductivity * material.density * material.specific_heat));
    }
  contact.correct({.time = state_.time,
                   .dt = dt,
                   .dt_mean = dt_mean,
                   .position = node.position,
                   .velocity = node.velocity,
                   .mass = inertia(),
                   .flow_stress = flow_stress,
                   .effusivity = effusivity,
                   .window = window});
  running_.tools = running_.friction = running_.recovery = 0.0;
  running_.impact = tie_loss_;
  const contact::ContactWork& bodies = contact.body_result().total;
  running_.recovery += bodies.recovery;
  running_.friction += bodies.friction;
  running_.impact += bodies.impact;
  for (std::size_t t = 0; t < contact.tools().size(); ++t) {
    const contact::ToolResult<dim>& tool = contact.results()[t];
    if (!contact.tools()[t].drive) running_.tools += tool.total.tool;
    running_.recovery += tool.total.recovery;
    running_.friction += tool.total.friction;
    running_.impact += tool.total.impact;
  }
}

/// Friction heat and conductance of the contacts of the step.
template<int dim> void ExplicitSolver<dim>::take_contact_heat() {
  const contact::RigidContact<dim>& contact = model_.contact;
  if (!model_.thermal || !contact.active()) return;
  const std::vector<std::int32_t>& boundary = contact.boundary_nodes();
  for (std::size_t b = 0; b < boundary.size(); ++b)
    contact_heat_[static_cast<std::size_t>(boundary[b])] = contact.friction_heat()[b];
  touching_.clear();
  for (const contact::ContactPoint<dim>& touch : contact.points()) {
    const contact::ToolThermal& thermal = contact.tools()[static_cast<std::size_t>(touch.tool)].thermal;
    if (thermal.conductance > 0.0)
      touching_.tools.push_back({touch.node, thermal.conductance, touch.area, thermal.temperature});
  }
  if (const double conductance = contact.body_law().conductance; conductance > 0.0)
    for (const contact::BodyTouch<dim>& touch : contact.touches())
      touching_.bodies.push_back({touch.node, touch.facet, touch.weight, conductance, touch.area});
}

template<int dim> void ExplicitSolver<dim>::strain_and_stress(double dt) {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  PointState<dim>& point = state_.point;
  const auto stress_points = points_to_stress();
  const std::size_t n = point.size();
  const EdgePoints edge = edge_defect_.active(approximation_.links)
                              ? edge_defect_.points(shear_modulus_, point.plastic_strain)
                              : EdgePoints{};
  const bool exchange = exchange_.active(approximation_.links);
  if (exchange) exchange_.remember(point.pressure);
  std::vector<std::ptrdiff_t> bad(blocks(n), -1);
  std::vector<double> damping(blocks(n), 0.0), released(blocks(n), 0.0);
  running_.viscosity += sum_blocks(n, [&](std::size_t begin, std::size_t end) {
    deformation_gradient<dim>(op, position_, point.deformation, begin, end);
    interpolate<dim>(op, state_.node.temperature, point.temperature, begin, end);
    if (damage_.active()) damage_.weaken(point, begin, end);
    bad[begin / block_size] =
        plasticity::update_stress(model_.materials, point.material, stress_points,
                                  static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end), dt);
    if (damage_.active())
      released[begin / block_size] = damage_.update(op, model_.materials, point, begin, end, dt);
    const ViscousSums viscous =
        add_bulk_viscosity<dim>(model_.viscosity, op, point, density_, wave_modulus_, dt, jacobian_,
                                viscous_pressure_, flow_stress_, edge, stress_, begin, end);
    damping[begin / block_size] = viscous.damping;
    return viscous.dissipated;
  });
  for (const double energy : released) running_.damage += energy;
  viscosity_ratio_ = *std::max_element(damping.begin(), damping.end());
  for (const std::ptrdiff_t p : bad)
    if (p >= 0) diverged(static_cast<std::size_t>(p), "deformation gradient");
  if (!exchange) return;
  const auto energy = exchange_.apply(op, approximation_.links, reference_, dt, point, stress_);
  running_.pressure_exchange += energy.dissipated;
  plastic_offset_ += energy.plastic;
}

template<int dim> void ExplicitSolver<dim>::assemble_forces() {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  NodeState<dim>& node = state_.node;
  const std::size_t n = node.size();
  model_.loads.evaluate(state_.time, node.position, node.mass);
  for (std::size_t k = 0; k < dim; ++k) {
    if (model_.loads.empty())
      std::fill(node.force[k].begin(), node.force[k].end(), 0.0);
    else
      node.force[k] = model_.loads.force()[k];
  }
  if (edge_defect_.active(approximation_.links)) {
    std::vector<EdgeEnergy> energy(blocks(n));
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      energy[begin / block_size] = edge_defect_.apply(approximation_.links, op.volume, reference_, position_,
                                                      stress_, node.force, begin, end);
    });
    running_.stabilisation = 0.0;
    for (const EdgeEnergy& e : energy) {
      running_.stabilisation += e.stored;
      running_.penalty_release += e.released;
    }
  }
  for_each_block(n, [&](std::size_t begin, std::size_t end) {
    subtract_internal_force<dim>(op, stress_, node.force, begin, end);
  });
}

template<int dim> typename ExplicitSolver<dim>::Step ExplicitSolver<dim>::stable_step() {
  const PointState<dim>& point = state_.point;
  constexpr double far =
      100.0; // so much longer than a step that no deformation makes it matter before a renewal
  if (conduction_step_ < far * state_.step_before) conduction_step_ = 0.0; // measured anew
  if (!model_.mechanical) {
    measure_conduction_step();
    return {model_.safety * conduction_step_, 0, "conduction"};
  }
  if (local_.on()) return stable_macro_step();
  damage_.wave_moduli(model_.materials, point, jacobian_, wave_modulus_);
  const StableStep step = stable_mechanical_step(
      bound_, approximation_.mechanics, point.deformation, wave_modulus_, inertia(),
      edge_defect_.active(approximation_.links) ? model_.stabilisation : 0.0, viscosity_ratio_);
  if (!(step.dt > 0.0)) diverged(step.point, "stable step");
  return {model_.safety * step.dt, step.point, "elastic waves"};
}

template<int dim> void ExplicitSolver<dim>::diverged(std::size_t point, const std::string& field) const {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const std::size_t node = op.first_node(point);
  throw DivergenceError(
      fmt::format("the {} of {} {} means nothing any more at step {}, t = {:.6g} s: node {} stood at "
                  "({:.6g}, {:.6g}) m",
                  field, op.nodal ? "node" : "stress point", point, state_.step, state_.time, node,
                  state_.node.position[0][node], state_.node.position[1][node]),
      static_cast<int>(node), field);
}

template class ExplicitSolver<2>;

} // namespace cnem
