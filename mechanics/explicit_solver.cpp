#include "mechanics/explicit_solver.hpp"

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
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
  Reactions reactions(*this, first + (count - 1) * step, count);
  viscosity_ratio_ = 0.0;
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
  if (model_.thermal) {
    collect_contact_heat();
    heat_plastically();
    conduct(dt); // (58), staggered
  }
  book(times_.heat);
}

/// The stable step of each block of points, and from these the levels of the next macro step.
template<int dim> typename ExplicitSolver<dim>::Step ExplicitSolver<dim>::stable_step() {
  const PointState<dim>& point = state_.point;
  constexpr double far =
      100.0; // so much longer than a step that no deformation makes it matter before a renewal
  if (conduction_step_ < far * state_.step_before) conduction_step_ = 0.0; // measured anew
  if (!model_.mechanical) {
    measure_conduction_step();
    return {model_.safety * conduction_step_, 0, "conduction"};
  }
  damage_.wave_moduli(model_.materials, point, jacobian_, wave_modulus_);
  const double stabilisation = edge_defect_.active(approximation_.links) ? model_.stabilisation : 0.0;
  const auto bounds = bound_.evaluate(approximation_.mechanics, point.deformation, wave_modulus_, inertia(),
                                      local_.on() ? LocalSteps<dim>::block : block_size);
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
