#pragma once
// When something is due, checkpoints among it, how long the next step is, and when the reference is renewed.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// Times at which something is due: every `interval`, or a list; the run lands on them exactly.
class Schedule {
public:
  /// From 0 to `end`, both included.
  static Schedule every(double interval, double end);
  static Schedule at(const std::vector<double>& times, double end);
  /// Due at every step; lands on nothing.
  static Schedule every_step();

  /// The next time to land on; infinite when there is none.
  double next() const;
  /// Whether something is due at `time`; each entry is due once.
  bool due(double time, double tolerance);
  /// When something was due last, s; negative before.
  double last() const { return last_; }
  void archive(Archive& archive, const std::string& name);

private:
  std::vector<double> time_;
  std::size_t at_ = 0;
  bool every_step_ = false;
  double last_ = -1.0; ///< s, last time at which it was due
};

/// Chooses each step: the stable one, looked at every so often, shortened to land on the next event.
class StepControl {
public:
  explicit StepControl(const input::TimeControl& time) : time_(&time) {}

  /// Looks at the stable step anew: after a re-reference, and every `check_every` steps. Throws
  /// DivergenceError when it has collapsed.
  template<int dim> void refresh(ExplicitSolver<dim>& solver);
  /// Whether damping has grown since then by so much that the step is no longer stable: a shock, or a light
  /// node that a new reference has set ringing.
  template<int dim> bool outgrown(const ExplicitSolver<dim>& solver) const {
    return solver.critical_damping() > most_damping_;
  }
  /// The step from `now` towards the next event.
  double choose(double now, double event);

  double limit() const { return limit_; }
  /// The limit before `time.step.max` shortened it, s.
  double stable() const { return stable_; }
  const std::string& limited_by() const { return limited_by_; }
  /// Stress point that limits the step; none where a key, heat or the spring of a tool does.
  std::optional<std::size_t> point() const {
    if (limited_by_ != ExplicitSolver<2>::elastic_waves) return std::nullopt;
    return point_;
  }
  /// What limited the step, as fractions of all steps.
  std::vector<std::pair<std::string, double>> shares() const;
  void archive(Archive& archive);

private:
  const input::TimeControl* time_;
  double limit_ = 0.0, stable_ = 0.0;                             ///< s
  double first_ = 0.0;                                            ///< s, the stable step at the start
  double most_damping_ = std::numeric_limits<double>::infinity(); ///< –, with which `limit_` is stable
  std::string limited_by_;
  std::size_t point_ = 0;
  std::map<std::string, std::int64_t> count_;
};

/// Renews the reference when it is due. Where two nodes have passed each other the present configuration
/// cannot be one: the run then goes on with the old reference, which still holds it, and tries again later,
/// unless it is stretched too far to mean anything.
class ReferenceRenewal {
public:
  /// quiet_every: steps between renewals by count at most (input::Adaptation); 0: as many as the method says.
  explicit ReferenceRenewal(const input::Method& method, int quiet_every = 0)
      : method_(&method), quiet_every_(quiet_every), interval_(method.rereference_every) {}

  /// Whether a strain of the case calls for renewals; nothing could come sooner otherwise.
  bool by_strain() const;
  /// With a `share` below 1 of the strain of the case, which is looked at every step then.
  template<int dim> bool due(const ExplicitSolver<dim>& solver, double share = 1.0) const;
  /// Whether the reference is a new one. Throws GeometryError. `prepare` renews the reference and leaves the
  /// solver as it is when it throws one; it is tried again after so much less the smaller the share is.
  template<int dim>
  bool renew(const ExplicitSolver<dim>& solver, const std::function<void()>& prepare, double share = 1.0);
  /// After a renewal that changed this share of the nodes: where it was hardly any the next one by count
  /// comes after twice as many steps.
  void rest(double changed);
  /// What to tell about it; empty when every renewal succeeded.
  std::string warning() const;
  void archive(Archive& archive);

private:
  const input::Method* method_;
  int quiet_every_;       ///< steps; 0: the interval stays
  int interval_;          ///< steps to the next renewal by count; 0: none
  std::int64_t last_ = 0; ///< step of the last renewal, or when to try again
  int postponed_ = 0;
  std::string first_;
};

/// When checkpoints are due by steps, simulated time and wall clock.
class CheckpointTimer {
public:
  explicit CheckpointTimer(const input::CheckpointControl& control) : control_(&control) {}
  bool due(std::int64_t step, double time) const;
  /// A checkpoint of this step and time (s) is there.
  void written(std::int64_t step, double time);

private:
  const input::CheckpointControl* control_;
  std::int64_t step_ = -1; ///< of the last one; −1: none yet
  double next_time_ = 0.0; ///< s
  double wall_ = 0.0;      ///< s, wall_time() of the last one
};

} // namespace cnem::app
