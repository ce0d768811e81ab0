#include "mechanics/explicit_solver.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/clock.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/explicit_reactions.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace cnem {

/// One macro step: 2^L finest steps, in each of which nodes and points move and flow at the rate of their
/// level; without local time steps L = 0 and the macro step is the step.
template<int dim> void ExplicitSolver<dim>::advance(double dt) {
  const double start = state_.time, step = dt / sub_steps();
  double lap = wall_time();
  const auto book = [&](double& part) {
    const double now = wall_time();
    part += now - std::exchange(lap, now);
  };
  if (!next_levels_.empty()) change_levels(step);
  const int count = local_.sub_steps();
  const double first = 0.5 * (finest_before_ + step);
  MeanReactions<dim> reactions(conditions_, first + (count - 1) * step, count);
  each([&](Term<dim>& term) { term.begin_step(body()); });
  int activity = local_.highest();
  for (int s = 1; s <= count; ++s) {
    const double dt_mean = s == 1 ? first : step;
    const int before = std::exchange(activity, local_.activity(s));
    if (model_.mechanical) {
      move(before, step, dt_mean); // (i)   (54), (55), corrected by supports and contact
      reactions.add(dt_mean);
      book(times_.motion);
      update_stress(activity, before, step); // (ii)  Box 2
      book(times_.stress);
    }
    state_.time = start + s * step;
    if (s == count) ++state_.step;
    if (model_.mechanical) assemble_forces(activity); // (iii) (52), (53)
    book(times_.forces);
  }
  reactions.report();
  state_.step_before = dt;
  finest_before_ = step;
  on_new_reference_ = false;
  each([&](Term<dim>& term) { term.end_step(body(), dt); }); // (58), staggered
  book(times_.heat);
}

/// The nodes that are due at an activity move by their own step; `dt` is the finest one.
template<int dim> void ExplicitSolver<dim>::move(int activity, double dt, double dt_mean) {
  NodeState<dim>& node = state_.node;
  const Field& inertia = node.inertia();
  const std::vector<LevelRange>& due = local_.moved(activity);
  conditions_.contact.remember(node.velocity);
  for_each_range(due, [&](const LevelRange& range) {
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = range.begin; i < range.end; ++i) {
        const double before = node.velocity_before[k][i] = node.velocity[k][i];
        if (range.marked) node.velocity[k][i] = before + dt_mean * node.force[k][i] / inertia[i];
      }
  });
  each([&](Term<dim>& term) { term.guide(body(), dt, dt_mean); });
  for_each_range(due, [&](const LevelRange& range) {
    const double own = dt * (1 << range.level);
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t i = range.begin; i < range.end; ++i) node.position[k][i] += own * node.velocity[k][i];
  });
  const double start = wall_time();
  each([&](Term<dim>& term) { term.correct(body(), activity, dt, dt_mean); });
  const double contact = wall_time() - start;
  times_.contact += contact;
  times_.motion -= contact; // whoever times the whole motion counts it too
  for_each_range(due, [&](const LevelRange& range) {
    place_side_by_side<dim>(node.position, position_, range.begin, range.end);
  });
  each([&](Term<dim>& term) { term.moved(body(), activity, dt_mean); });
  start_weight_.clear();
}

/// Stresses of the points that are due, each over its own step; `dt` is the finest one, `before` the activity
/// that the last stresses were made at.
template<int dim> void ExplicitSolver<dim>::update_stress(int activity, int before, double dt) {
  PointState<dim>& point = state_.point;
  const DuePoints due{local_.points(activity), activity, activity == local_.highest(), dt};
  const Body<dim> body = this->body();
  edge_ = {};
  each([&](Term<dim>& term) { term.begin_stress(body, due); });
  if (!due.whole)
    for_each_range(local_.silenced(before), [&](const LevelRange& range) {
      fill_records(stress_.columns, column_stress<dim>, range, 0.0);
      if constexpr (dim == 2) fill_records(stress_.out_of_plane, 1, range, 0.0);
    });
  const auto points = plasticity::stress_points(point);
  std::vector<std::ptrdiff_t> bad(due.ranges.size(), -1);
  for_each_range(due.ranges, [&](const LevelRange& range) {
    const std::size_t begin = range.begin, end = range.end;
    deformation_gradient<dim>(body.operators(), position_, point.deformation, begin, end);
    interpolate<dim>(body.operators(), state_.node.temperature, point.temperature, begin, end);
    each([&](Term<dim>& term) { term.before_stress(body, range); });
    bad[due.index(range)] = plasticity::update_stress(model_.materials, point.material, points,
                                                      static_cast<std::ptrdiff_t>(begin),
                                                      static_cast<std::ptrdiff_t>(end), due.own(range));
    each([&](Term<dim>& term) { term.after_stress(body, due, range); });
  });
  for (const std::ptrdiff_t p : bad)
    if (p >= 0) diverged(index_of(p), "deformation gradient");
  each([&](Term<dim>& term) { term.end_stress(body, due); });
}

/// What points and loads give to the nodes that are kicked at an activity: each its force times the number of
/// finest steps in its own.
template<int dim> void ExplicitSolver<dim>::assemble_forces(int activity) {
  const Body<dim> body = this->body();
  Fields<dim>& force = state_.node.force;
  each([&](Term<dim>& term) { term.begin_forces(body, activity); });
  const bool nodal = body.operators().nodal;
  if (nodal || local_.highest() > 0)
    for_each_range(local_.points(activity), [&](const LevelRange& range) {
      if (nodal) {
        for (Field& component : force) fill_records(component, 1, range, 0.0);
        each([&](Term<dim>& term) { term.add_forces(body, activity, range); });
      }
      if (range.level > 0) scale_to_impulses(range);
    });
  each([&](Term<dim>& term) { term.end_forces(body, activity); });
  for_each_range(local_.kicked(activity), [&](const LevelRange& range) {
    if (!range.marked) // its own points are not due
      for (Field& component : force) fill_records(component, 1, range, 0.0);
    each([&](Term<dim>& term) { term.add_loads(body, range); });
    subtract_internal_force<dim>(body.operators(), stress_, force, range.begin, range.end);
  });
}

/// The stable step of each block of points, and from these the levels of the next macro step.
template<int dim> typename ExplicitSolver<dim>::Step ExplicitSolver<dim>::stable_step() {
  StepLimit limit;
  each([&](Term<dim>& term) { term.limit(body(), limit); });
  limit.critical_damping = critical_damping();
  if (!model_.mechanical) return {model_.safety * limit.heat, 0, "conduction"};
  const DiscreteOperators<dim>& op = approximation_->mechanics;
  const PointState<dim>& point = state_.point;
  const auto step_of = [&](const typename SpectralBound<dim>::Result& bound) {
    const double step =
        stable_wave_step(bound.value + limit.springs, limit.stabilisation, limit.critical_damping);
    if (!(step > 0.0)) diverged(bound.point, "stable step");
    return step;
  };
  const auto within = [&](double finest, int steps, std::size_t where) -> Step {
    if (limit.tools < finest) return {model_.safety * steps * limit.tools, where, "springs of tools"};
    return {model_.safety * steps * finest, where, elastic_waves};
  };
  next_levels_.clear();
  if (local_.on()) {
    const auto bounds = bound_.of_ranges(op, point.deformation, point.wave_modulus, state_.node.inertia(),
                                         LocalSteps<dim>::block, conditions_.ties);
    Field stable(bounds.size());
    for (std::size_t b = 0; b < bounds.size(); ++b) stable[b] = step_of(bounds[b]);
    auto level = local_.choose(op, approximation_->links, stable);
    const auto [finest, limiting] = local_.finest_step(level, stable);
    if (level != local_.level()) next_levels_ = std::move(level);
    // Several levels keep the distance that rows leave: nearer the exact step, borders may resonate.
    if (sub_steps() > 1) return within(finest, sub_steps(), bounds[limiting].point);
  }
  const auto bound =
      bound_.of_all(op, point.deformation, point.wave_modulus, state_.node.inertia(), conditions_.ties);
  return within(step_of(bound), 1, bound.point);
}

template<int dim> double ExplicitSolver<dim>::critical_damping() const {
  double sum = 0.0;
  each([&](const Term<dim>& term) { sum += term.critical_damping(); });
  return sum;
}

template<int dim> Body<dim> ExplicitSolver<dim>::body() {
  return {model_,  conditions_, state_,          *approximation_,      local_,       reference_, position_,
          stress_, edge_,       plastic_offset_, 0.5 * finest_before_, start_weight_};
}
template<int dim> BodyView<dim> ExplicitSolver<dim>::body() const {
  return {model_,  conditions_, state_,          *approximation_,      local_,       reference_, position_,
          stress_, edge_,       plastic_offset_, 0.5 * finest_before_, start_weight_};
}

template<int dim> void ExplicitSolver<dim>::diverged(std::size_t point, const std::string& field) const {
  const DiscreteOperators<dim>& op = approximation_->mechanics;
  const std::size_t node = index_of(op.first_node(point));
  std::array<double, dim> place;
  for (std::size_t k = 0; k < dim; ++k) place[k] = state_.node.position[k][node];
  throw DivergenceError(
      fmt::format("the {} of {} {} means nothing any more at step {}, t = {:.6g} s: node {} stood at "
                  "({:.6g}) m",
                  field, op.nodal ? "node" : "stress point", point, state_.step, state_.time, node,
                  fmt::join(place, ", ")),
      static_cast<int>(node), field);
}

template<int dim> void ExplicitSolver<dim>::hold(std::vector<Support<dim>> supports) {
  conditions_.supports.replace(std::move(supports), state_.node.size());
}

template class ExplicitSolver<2>;
template class ExplicitSolver<3>;

} // namespace cnem
