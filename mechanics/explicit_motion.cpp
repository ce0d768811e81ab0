// Part (i) of a step: nodes move, held by supports, ties and contact.
#include "core/clock.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"

#include <cmath>

namespace cnem {

/// The nodes that are due at an activity move by their own step; `dt` is the finest one.
template<int dim> void ExplicitSolver<dim>::move(int activity, double dt, double dt_mean) {
  NodeState<dim>& node = state_.node;
  const Field& inertia = this->inertia();
  const std::vector<LevelRange>& due = local_.moved(activity);
  model_.contact.remember(node.velocity);
  for_each_range(due, [&](const LevelRange& range) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const double before = velocity_before_[k][i] = node.velocity[k][i];
        if (range.marked) node.velocity[k][i] = before + dt_mean * node.force[k][i] / inertia[i];
      }
  });
  if (!model_.ties.empty())
    for (Field& component : node.velocity) model_.ties.share(inertia, component);
  model_.supports.apply(state_.time, dt, dt_mean, inertia, velocity_before_, node.velocity);
  running_.supports = model_.supports.work();
  for_each_range(due, [&](const LevelRange& range) {
    const double own = dt * (1 << range.level);
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = range.begin; i < range.end; ++i) node.position[k][i] += own * node.velocity[k][i];
  });

  const double start = wall_time();
  correct_contact(dt, dt_mean,
                  window_.empty() ? std::span<const double>() : window_[static_cast<std::size_t>(activity)]);
  const double contact = wall_time() - start;
  times_.contact += contact;
  times_.motion -= contact; // whoever times the whole motion counts it too
  if (!model_.ties.empty()) tie_loss_ += model_.ties.share_motion(inertia, dt, node.velocity, node.position);
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
template<int dim> void ExplicitSolver<dim>::collect_contact_heat() {
  const contact::RigidContact<dim>& contact = model_.contact;
  if (!model_.thermal || !contact.active()) return;
  const std::vector<std::int32_t>& boundary = contact.boundary_nodes();
  for (std::size_t b = 0; b < boundary.size(); ++b)
    contact_heat_[static_cast<std::size_t>(boundary[b])] = contact.friction_heat()[b];
  heat_contacts_.clear();
  for (const contact::ContactPoint<dim>& touch : contact.points()) {
    const contact::ToolThermal& thermal = contact.tools()[static_cast<std::size_t>(touch.tool)].thermal;
    if (thermal.conductance > 0.0)
      heat_contacts_.tools.push_back({touch.node, thermal.conductance, touch.area, thermal.temperature});
  }
  if (const double conductance = contact.body_law().conductance; conductance > 0.0)
    for (const contact::BodyTouch<dim>& touch : contact.touches())
      heat_contacts_.bodies.push_back({touch.node, touch.facet, touch.weight, conductance, touch.area});
}

template void ExplicitSolver<2>::move(int, double, double);
template void ExplicitSolver<2>::correct_contact(double, double, std::span<const double>);
template void ExplicitSolver<2>::collect_contact_heat();

} // namespace cnem
