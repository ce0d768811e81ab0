#include "app/run.hpp"

#include "app/fields.hpp"
#include "app/recorder.hpp"
#include "app/registry.hpp"
#include "app/statics.hpp"
#include "app/stopwatch.hpp"
#include "io/output_folder.hpp"
#include "io/progress.hpp"
#include "io/report.hpp"
#include "io/status.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <omp.h>

namespace cnem::app {

namespace {

/// Times at which something is due: every `interval`, or a list; the run lands on them exactly.
class Schedule {
public:
  Schedule(double interval, double end) {
    const auto count = static_cast<long>(std::floor(end / interval * (1.0 + 1e-12)));
    for (long k = 0; k <= count; ++k) time_.push_back(static_cast<double>(k) * interval);
    if (time_.back() < end * (1.0 - 1e-9)) time_.push_back(end);
  }
  Schedule(std::vector<double> times, double end) {
    for (const double t : times)
      if (t <= end * (1.0 + 1e-12)) time_.push_back(std::min(t, end));
  }
  double next() const { return at_ < time_.size() ? time_[at_] : std::numeric_limits<double>::infinity(); }
  /// Whether something is due at `time`; each entry is due once.
  bool due(double time, double tolerance) {
    bool any = false;
    while (at_ < time_.size() && time >= time_[at_] - tolerance) {
      ++at_;
      any = true;
    }
    return any;
  }

private:
  std::vector<double> time_;
  std::size_t at_ = 0;
};

/// Chooses each step: the stable one, looked at every so often, shortened to land on the next event.
class StepControl {
public:
  explicit StepControl(const io::TimeControl& time) : time_(&time) {}

  /// Looks at the stable step anew: after a re-reference, and every `check_every` steps.
  void refresh(ExplicitSolver<2>& solver) {
    if (time_->fixed) {
      limit_ = *time_->fixed;
      limited_by_ = "fixed step";
      return;
    }
    const auto stable = solver.stable_step();
    limit_ = stable.dt;
    point_ = stable.point;
    limited_by_ = "elastic waves";
    if (time_->max_step && *time_->max_step < limit_) {
      limit_ = *time_->max_step;
      limited_by_ = "time.step.max";
    }
  }
  double choose(double now, double event) {
    ++count_[limited_by_];
    const double remaining = event - now;
    const double pieces = std::ceil(remaining / limit_ * (1.0 - 1e-9));
    return remaining / std::max(1.0, pieces);
  }
  double limit() const { return limit_; }
  const std::string& limited_by() const { return limited_by_; }
  std::size_t point() const { return point_; }
  std::vector<std::pair<std::string, double>> shares() const {
    double total = 0.0;
    for (const auto& [name, count] : count_) total += static_cast<double>(count);
    std::vector<std::pair<std::string, double>> list;
    for (const auto& [name, count] : count_) list.emplace_back(name, static_cast<double>(count) / total);
    return list;
  }

private:
  const io::TimeControl* time_;
  double limit_ = 0.0;
  std::string limited_by_;
  std::size_t point_ = 0;
  std::map<std::string, long> count_;
};

bool reference_due(const io::Method& method, const ExplicitSolver<2>& solver, std::int64_t last) {
  const std::int64_t steps = solver.state().step - last;
  switch (method.lagrangian) {
  case io::Method::Lagrangian::total:
    return false;
  case io::Method::Lagrangian::updated:
    return steps >= 1;
  case io::Method::Lagrangian::periodic:
    break;
  }
  if (method.rereference_every > 0 && steps >= method.rereference_every) return true;
  constexpr std::int64_t look_every = 5;
  return method.rereference_strain > 0.0 && steps > 0 && steps % look_every == 0 &&
         solver.strain_since_reference() > method.rereference_strain;
}

/// Renews the reference. Where two nodes have passed each other the present configuration cannot be one: the
/// run then goes on with the old reference, which still holds it, and tries again later, unless it is
/// stretched too far to mean anything.
class ReferenceRenewal {
public:
  void renew(ExplicitSolver<2>& solver) {
    wait_ = 0;
    try {
      solver.prepare();
    } catch (const GeometryError& error) {
      constexpr double too_far = 4.0;
      if (solver.strain_since_reference() > too_far) throw;
      wait_ = 100;
      if (postponed_++ == 0)
        first_ =
            fmt::format("step {}, t = {:.4g} s ({})", solver.state().step, solver.state().time, error.what());
    }
  }
  /// Steps to let pass before the next attempt.
  std::int64_t wait() const { return wait_; }
  /// What to tell about it; empty when every renewal succeeded.
  std::string warning() const {
    if (postponed_ == 0) return "";
    return fmt::format(
        "the reference could not be renewed {} times, first at {}: the run went on with an older one",
        postponed_, first_);
  }

private:
  std::int64_t wait_ = 0;
  int postponed_ = 0;
  std::string first_;
};

void set_threads(int threads) {
  if (threads > 0) omp_set_num_threads(threads);
}

ExplicitSolver<2> make_solver(const io::Case& input, std::vector<std::string>& warnings) {
  Setup setup = build(input);
  warnings = std::move(setup.warnings);
  try {
    return {std::move(setup.model), std::move(setup.velocity), std::move(setup.temperature)};
  } catch (const GeometryError& error) { throw input.error("domain", error.what()); }
}

io::PostMortem post_mortem(const DivergenceError& error, const State<2>& state) {
  io::PostMortem dead;
  dead.step = state.step;
  dead.time = state.time;
  dead.node = error.node;
  if (error.node >= 0) {
    dead.x = state.node.position[0][static_cast<std::size_t>(error.node)];
    dead.y = state.node.position[1][static_cast<std::size_t>(error.node)];
  }
  dead.field = error.field;
  dead.text = error.what();
  return dead;
}

/// The energy residual has no place of its own: the fastest node shows where the run has come apart.
DivergenceError energy_divergence(double share, double tolerance, const State<2>& state) {
  const Fields<2>& v = state.node.velocity;
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < state.node.size(); ++i)
    if (!(std::hypot(v[0][i], v[1][i]) <= std::hypot(v[0][fastest], v[1][fastest]))) fastest = i;
  return {
      fmt::format(
          "the energy residual is {:.3g} of the work done, more than method.energy_tolerance = {:.3g} "
          "allows, at step {}, t = {:.6g} s; the fastest node is {} at ({:.6g}, {:.6g}) m with {:.3g} m/s",
          share, tolerance, state.step, state.time, fastest, state.node.position[0][fastest],
          state.node.position[1][fastest], std::hypot(v[0][fastest], v[1][fastest])),
      static_cast<int>(fastest), "energy residual"};
}

} // namespace

Exit run(const io::Case& input, const RunOptions& options) {
  if (input.analysis.type == io::Analysis::Type::statics) return run_static(input, options);
  set_threads(options.threads);
  Stopwatch watch;
  std::vector<std::string> warnings;
  ExplicitSolver<2> solver = watch.time("setup", [&] { return make_solver(input, warnings); });
  const State<2>& state = solver.state();

  io::prepare_output_folder(options.output, options.force);
  io::write_atomically(options.output / io::files::resolved_case, input.resolved);
  HistoryRecorder history(input, solver, options.output);
  FieldRecorder fields(options.output);
  PictureRecorder pictures(input, options.output);

  const double end = input.time.end, tolerance = 1e-9 * end;
  Schedule history_due(input.output.history_every, end), fields_due(input.output.fields_every, end),
      pictures_due(input.output.pictures, end);
  StepControl control(input.time);
  io::Progress progress;
  for (const std::string& warning : warnings) progress.message("warning: " + warning);

  ReferenceRenewal renewal;
  std::int64_t last_reference = 0, last_check = -1;
  double node_steps = 0.0;
  Exit exit = Exit::done;
  std::string reason = "reached the end of the run";
  std::optional<io::PostMortem> dead;
  try {
    watch.time("step", [&] { control.refresh(solver); });
    while (true) {
      watch.time("output", [&] {
        if (history_due.due(state.time, tolerance)) history.record(solver);
        if (fields_due.due(state.time, tolerance)) fields.record(snapshot(solver));
        if (pictures_due.due(state.time, tolerance)) pictures.record(snapshot(solver));
        progress.update({.time = state.time,
                         .end = end,
                         .step = state.step,
                         .dt = state.step_before,
                         .nodes = static_cast<std::int64_t>(state.node.size())});
      });
      if (state.time >= end - tolerance) break;
      if (const double share = std::abs(history.last_residual()) / history.energy_scale();
          history.energy_scale() > 0.0 && share > input.method.energy_tolerance)
        throw energy_divergence(share, input.method.energy_tolerance, state);
      const bool rereference =
          watch.time("step", [&] { return reference_due(input.method, solver, last_reference); });
      if (rereference) {
        watch.time("rebuild", [&] { renewal.renew(solver); });
        last_reference = state.step + renewal.wait();
      }
      watch.time("step", [&] {
        if (rereference || state.step - last_check >= input.time.check_every) {
          control.refresh(solver);
          last_check = state.step;
        }
        solver.advance(control.choose(state.time, std::min({end, fields_due.next(), pictures_due.next()})));
      });
      node_steps += static_cast<double>(state.node.size());
    }
  } catch (const DivergenceError& error) {
    exit = Exit::diverged;
    reason = error.what();
    dead = post_mortem(error, state);
  } catch (const GeometryError& error) {
    exit = Exit::diverged;
    reason = fmt::format("the cloud could not be rebuilt at step {}, t = {:.6g} s: {}", state.step,
                         state.time, error.what());
    dead = post_mortem(DivergenceError(reason, -1, "geometry"), state);
  }
  watch.time("output", [&] { write_lines(input, snapshot(solver), options.output); });
  progress.finish();

  io::RunStatus status;
  status.exit = exit;
  status.reason = reason;
  status.version = options.version;
  status.case_name = input.name;
  status.time = state.time;
  status.steps = state.step;
  status.nodes = static_cast<std::int64_t>(state.node.size());
  status.node_steps = static_cast<std::int64_t>(node_steps);
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = io::peak_rss_bytes();
  status.energy_residual = history.energy_residual();
  status.metrics = history.metrics();
  status.metrics.emplace_back("references", solver.references());
  status.step_limits = control.shares();
  status.warnings = warnings;
  if (const std::string warning = renewal.warning(); !warning.empty()) {
    status.warnings.push_back(warning);
    progress.message("warning: " + warning);
  }
  status.post_mortem = dead;
  status.wall_s = watch.spent();
  io::write_status(options.output, status);
  const std::filesystem::path report = io::write_report(options.output);
  fmt::print("{}: {}\n", exit == Exit::done ? "done" : "diverged", reason);
  fmt::print("{} nodes, {} steps to t = {:.4g} s in {:.1f} s; energy residual {:.2g} of the work\n",
             status.nodes, status.steps, state.time, status.wall_s.front().second, status.energy_residual);
  fmt::print("report: {}\n", report.string());
  return exit;
}

void check(const io::Case& input, const RunOptions& options) {
  if (input.analysis.type == io::Analysis::Type::statics) return check_static(input, options);
  set_threads(options.threads);
  std::vector<std::string> warnings;
  ExplicitSolver<2> solver = make_solver(input, warnings);
  StepControl control(input.time);
  control.refresh(solver);
  const State<2>& state = solver.state();
  const std::size_t node =
      solver.approximation().mechanics.nodal
          ? control.point()
          : static_cast<std::size_t>(solver.approximation().mechanics.node[static_cast<std::size_t>(
                solver.approximation().mechanics.row_begin[control.point()])]);
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  fmt::print("case        {}\n", input.title.empty() ? input.name : input.title);
  fmt::print("nodes       {}\n", state.node.size());
  fmt::print("points      {}\n", state.point.size());
  fmt::print("area        {:.9g} m²\n", boundary_area(snapshot(solver)));
  fmt::print("first step  {:.4g} s, limited by {}", control.limit(), control.limited_by());
  if (!input.time.fixed)
    fmt::print(" at ({:.4g}, {:.4g}) m", state.node.position[0][node], state.node.position[1][node]);
  fmt::print("\nsteps       about {:.0f} to t = {:.4g} s\n", std::ceil(input.time.end / control.limit()),
             input.time.end);
  fmt::print("memory      {:.0f} MB\n", static_cast<double>(io::peak_rss_bytes()) / 1e6);
  const auto overlaps = solver.model().contact.overlaps(state.node.position, 0.0);
  if (overlaps.empty()) {
    fmt::print("tools       {} without overlap\n", solver.model().contact.tools().size());
  } else {
    fmt::print("tools       {} places where a tool overlaps the workpiece, the deepest:\n", overlaps.size());
    for (std::size_t k = 0; k < std::min<std::size_t>(overlaps.size(), 3); ++k)
      fmt::print("            {} by {:.3g} m at ({:.4g}, {:.4g}) m\n",
                 solver.model().contact.tools()[static_cast<std::size_t>(overlaps[k].tool)].name,
                 overlaps[k].depth, overlaps[k].position.x(), overlaps[k].position.y());
  }
  const std::filesystem::path folder = options.output / "initial";
  io::prepare_output_folder(folder, true);
  FieldRecorder(folder).record(snapshot(solver));
  fmt::print("fields      {}\n", (folder / io::files::fields).string());
}

} // namespace cnem::app
