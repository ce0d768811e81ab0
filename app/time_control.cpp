#include "app/time_control.hpp"

#include "app/divergence.hpp"
#include "core/error.hpp"
#include "core/machine/clock.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::app {

Schedule Schedule::every(double interval, double end) {
  Schedule schedule;
  const auto count = static_cast<long>(std::floor(end / interval * (1.0 + 1e-12)));
  for (long k = 0; k <= count; ++k) schedule.time_.push_back(static_cast<double>(k) * interval);
  if (schedule.time_.back() < end * (1.0 - 1e-9)) schedule.time_.push_back(end);
  return schedule;
}

Schedule Schedule::at(const std::vector<double>& times, double end) {
  Schedule schedule;
  for (const double t : times)
    if (t <= end * (1.0 + 1e-12)) schedule.time_.push_back(std::min(t, end));
  return schedule;
}

Schedule Schedule::every_step() {
  Schedule schedule;
  schedule.every_step_ = true;
  return schedule;
}

double Schedule::next() const {
  return at_ < time_.size() ? time_[at_] : std::numeric_limits<double>::infinity();
}

bool Schedule::due(double time, double tolerance) {
  bool any = every_step_ && time > last_;
  while (at_ < time_.size() && time >= time_[at_] - tolerance) {
    ++at_;
    any = true;
  }
  if (any) last_ = time;
  return any;
}

void Schedule::archive(Archive& archive, const std::string& name) {
  archive.integer(name + "/next", at_);
  archive.number(name + "/last", "s", last_);
}

template<int dim> void StepControl::refresh(ExplicitSolver<dim>& solver) {
  if (time_->fixed) {
    limit_ = stable_ = *time_->fixed;
    limited_by_ = "fixed step";
    return;
  }
  const auto stable = solver.stable_step();
  limit_ = stable_ = stable.dt;
  point_ = stable.point;
  limited_by_ = stable.limit;
  const double finest = stable.dt / solver.sub_steps();
  if (first_ == 0.0) first_ = finest;
  constexpr double collapsed = 1e-3;
  if (const double least = time_->min_step.value_or(collapsed * first_); finest < least) {
    const std::string below = fmt::format(
        "{} = {:.3g} s", time_->min_step ? "time.step.min" : "a thousandth of the first one", least);
    if (point()) throw step_collapse(solver, stable.point, finest, below);
    throw DivergenceError(
        fmt::format("the stable step has fallen to {:.3g} s, below {}, at step {}, t = {:.6g} s, "
                    "because of {}",
                    finest, below, solver.state().step, solver.state().time, limited_by_),
        -1, "stable step");
  }
  if (time_->max_step && *time_->max_step < limit_) {
    limit_ = *time_->max_step;
    limited_by_ = "time.step.max";
  }
  most_damping_ =
      damping_of_step(solver.model().safety * damped_step(solver.critical_damping()) * limit_ / stable_);
}

double StepControl::choose(double now, double event) {
  ++count_[limited_by_];
  const double remaining = event - now;
  const double pieces = std::ceil(remaining / limit_ * (1.0 - 1e-9));
  return remaining / std::max(1.0, pieces);
}

std::vector<std::pair<std::string, double>> StepControl::shares() const {
  double total = 0.0;
  for (const auto& [name, count] : count_) total += static_cast<double>(count);
  std::vector<std::pair<std::string, double>> list;
  for (const auto& [name, count] : count_) list.emplace_back(name, static_cast<double>(count) / total);
  return list;
}

void StepControl::archive(Archive& archive) {
  archive.number("run/step/limit", "s", limit_);
  archive.number("run/step/first", "s", first_);
  archive.number("run/step/most_damping", "1", most_damping_);
  archive.text("run/step/limited_by", limited_by_);
  archive.integer("run/step/point", point_);
  std::vector<std::string> names;
  for (const auto& [name, count] : count_) names.push_back(name);
  archive.texts("run/step/limits", names);
  if (archive.loading()) count_.clear();
  for (const std::string& name : names) archive.integer(fmt::format("run/step/count/{}", name), count_[name]);
}

bool ReferenceRenewal::by_strain() const {
  return method_->lagrangian == input::Method::Lagrangian::periodic && method_->rereference_strain > 0.0;
}

template<int dim> bool ReferenceRenewal::due(const ExplicitSolver<dim>& solver, double share) const {
  const std::int64_t steps = solver.state().step - last_;
  switch (method_->lagrangian) {
  case input::Method::Lagrangian::total:
    return false;
  case input::Method::Lagrangian::updated:
    return steps >= 1;
  case input::Method::Lagrangian::periodic:
    break;
  }
  const std::int64_t finest = solver.sub_steps();
  if (interval_ > 0 && steps * finest >= interval_) return true;
  const std::int64_t look_every = share < 1.0 ? 1 : std::max<std::int64_t>(1, 5 / finest);
  return by_strain() && steps > 0 && steps % look_every == 0 &&
         solver.strain_since_reference() > share * method_->rereference_strain;
}

template<int dim>
bool ReferenceRenewal::renew(const ExplicitSolver<dim>& solver, const std::function<void()>& prepare,
                             double share) {
  last_ = solver.state().step;
  try {
    prepare();
    return true;
  } catch (const GeometryError& error) {
    constexpr double too_far = 4.0;
    if (solver.strain_since_reference() > too_far) throw;
    constexpr double wait = 100.0; // finest steps
    last_ += static_cast<std::int64_t>(share * wait / solver.sub_steps());
    if (postponed_++ == 0)
      first_ =
          fmt::format("step {}, t = {:.4g} s ({})", solver.state().step, solver.state().time, error.what());
    return false;
  }
}

void ReferenceRenewal::rest(double changed) {
  constexpr double hardly_any = 1.0 / 200.0;
  interval_ = changed < hardly_any ? std::max(interval_, std::min(2 * interval_, quiet_every_))
                                   : method_->rereference_every;
}

std::string ReferenceRenewal::warning() const {
  if (postponed_ == 0) return "";
  return fmt::format(
      "the reference could not be renewed {} times, first at {}: the run went on with an older one",
      postponed_, first_);
}

void ReferenceRenewal::archive(Archive& archive) {
  archive.integer("run/reference/last", last_);
  archive.integer("run/reference/interval", interval_);
  archive.integer("run/reference/postponed", postponed_);
  archive.text("run/reference/first_postponed", first_);
}

bool CheckpointTimer::due(std::int64_t step, double time) const {
  return step_ < 0 || (control_->every_steps > 0 && step >= step_ + control_->every_steps) ||
         (control_->every_time > 0.0 && time >= next_time_) ||
         (control_->every_wall > 0.0 && wall_time() >= wall_ + control_->every_wall);
}

void CheckpointTimer::written(std::int64_t step, double time) {
  step_ = step;
  wall_ = wall_time();
  if (control_->every_time > 0.0)
    next_time_ = (std::floor(time / control_->every_time) + 1.0) * control_->every_time;
}

template void StepControl::refresh(ExplicitSolver<2>&);
template void StepControl::refresh(ExplicitSolver<3>&);
template bool ReferenceRenewal::due(const ExplicitSolver<2>&, double) const;
template bool ReferenceRenewal::due(const ExplicitSolver<3>&, double) const;
template bool ReferenceRenewal::renew(const ExplicitSolver<2>&, const std::function<void()>&, double);
template bool ReferenceRenewal::renew(const ExplicitSolver<3>&, const std::function<void()>&, double);

} // namespace cnem::app
