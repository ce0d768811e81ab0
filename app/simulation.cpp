#include "app/simulation.hpp"

#include "app/plausibility/plausibility.hpp"
#include "app/problem/registry.hpp"
#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "app/watches/fixed_step.hpp"
#include "app/watches/tool_speed.hpp"
#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "report/report.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <omp.h>

namespace cnem::app {

namespace {

Schedule every(double interval, double end, const Schedule& otherwise) {
  return interval > 0.0 ? Schedule::every(interval, end) : otherwise;
}

} // namespace

template<int dim>
ExplicitSolver<dim> make_solver(const input::Case& input, std::vector<std::string>& warnings) {
  Setup<dim> setup = build<dim>(input);
  warnings = std::move(setup.warnings);
  try {
    return {std::move(setup.problem), std::move(setup.velocity), std::move(setup.temperature)};
  } catch (const GeometryError& error) { throw input.error("domain", error.what()); }
}

template<int dim> void refuse_snap_back(const input::Case& input, const ExplicitSolver<dim>& solver) {
  constexpr const char* modes[] = {"Gft", "Gfc", "Gmt", "Gmc", "Gs"};
  const PointState<dim>& point = solver.state().point;
  for (std::size_t p = 0; p < point.failure_length.size(); ++p) {
    const plasticity::Material& material = solver.model().materials[index_of(point.material[p])];
    if (!material.failure) continue;
    const auto elastic = plasticity::ply_constants(*material.ply, solver.model().plane_stress);
    for (int mode = 0; mode < plasticity::ply_modes; ++mode)
      if (const double longest = material.failure->longest_length(elastic, mode);
          point.failure_length[p] >= longest)
        throw input.error(
            fmt::format("materials.{}.failure.{}", material.name, modes[mode]),
            fmt::format("found an energy that cells of a length of {:.4g} m cannot spend, "
                        "expected cells below 2 G E/X² = {:.4g} m: a finer cloud or more energy",
                        point.failure_length[p], longest));
  }
}

template<int dim>
Simulation<dim>::Simulation(const input::Case& input, const RunOptions& options, RunObserver& observer)
    : input_(input), options_(options), observer_(observer),
      solver_(watch_.time("setup", [&] { return make_solver<dim>(input, warnings_); })),
      history_(input, solver_, options.output, options.keep_history),
      lines_(input, solver_.conditions().cloud, solver_.approximation()),
      history_due_(every(input.output.history_every, input.time.end, Schedule::every_step())),
      fields_due_(every(input.output.fields_every, input.time.end,
                        Schedule::at({0.0, input.time.end}, input.time.end))),
      pictures_due_(Schedule::at(input.output.pictures, input.time.end)), control_(input.time),
      renewal_(input.method, input.adapt.quiet_every), retries_(renewal_.by_strain()),
      features_(input, solver_), checkpoints_(input.output.checkpoint) {
  refuse_snap_back(input, solver_);
  for (std::string& warning : supersonic_tools(input, solver_)) warn(std::move(warning));
  for (std::string& warning : unstable_fixed_step(input, solver_)) warn(std::move(warning));
  for (std::string& doubt : doubts(input, solver_)) warn(std::move(doubt));
}
template<int dim> void Simulation<dim>::check_tools() {
  if (input_.adapt.tool_spacing) return; // the step is known once the cloud fits the tools
  try {
    StepControl first(input_.time);
    first.refresh(solver_);
    check_tool_steps(input_, solver_, first.limit() / solver_.sub_steps());
  } catch (const DivergenceError&) {} // the run tells, with a report
}
template<int dim> void Simulation<dim>::start() {
  watch_.time("rebuild", [&] {
    features_.start(options_.output, solver_, [&](const Resampling<dim>& change) { follow(change); });
  });
  if (!options_.output.empty()) fields_.emplace(options_.output, input_);
}
template<int dim> std::optional<Exit> Simulation<dim>::go_on() {
  const bool stopped_in_memory = exit_ == Exit::interrupted && options_.output.empty();
  if (stage_ == Stage::ended && !stopped_in_memory) return exit_;
  if (stage_ == Stage::begun)
    for (const std::string& warning : warnings_) observer_.remark("warning: " + warning);
  stage_ = Stage::under_way;
  exit_ = Exit::done;
  reason_.clear();
  watch_.go_on();
  try {
    while (const std::optional<DivergenceError> failure = run_on())
      if (!go_back(*failure)) {
        diverge(*failure);
        break;
      }
    if (stage_ != Stage::paused) end();
    watch_.pause();
    return stage_ == Stage::paused ? std::nullopt : std::optional<Exit>(exit_);
  } catch (const IoError& error) {
    return fail(error.what());
  } catch (const std::system_error& error) { // files and threads
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    files_.give_up();
    return fail(memory_exhausted());
  }
}
template<int dim> void Simulation<dim>::end() {
  const bool in_folder = !options_.output.empty();
  watch_.time("output", [&] {
    if (in_folder && exit_ != Exit::interrupted) lines_.write(results::snapshot(solver_), options_.output);
    watch_.time("output.disk", [&] { files_.wait(); });
    watch_.time("output.pictures", [&] { features_.finish_pictures(files_); });
    watch_.time("output.disk", [&] { files_.wait(); });
    if (exit_ == Exit::done) features_.evaluate(options_.output, solver_, history_.log());
  });
  observer_.steps_end();
  stage_ = Stage::ended;
  for (const std::string& warning : late_warnings()) observer_.remark("warning: " + warning);
  results::RunStatus end = status();
  std::filesystem::path report;
  if (in_folder)
    report = watch_.time("output", [&] {
      return watch_.time("output.report", [&] { return report::write_report(options_.output, end); });
    });
  end.wall_s = wall();
  end.cpu_s = watch_.cpu();
  forget_last_words();
  if (in_folder) results::write_status(options_.output, end);
  observer_.outcome(fmt::format("{}: {}",
                                exit_ == Exit::done          ? "done"
                                : exit_ == Exit::interrupted ? "stopped"
                                                             : "diverged",
                                reason_));
  const bool moves = input_.analysis.mechanical;
  observer_.outcome(fmt::format("{} nodes, {} steps to t = {:.4g} s in {:.1f} s; {} {:.2g} of the {}",
                                end.nodes, end.steps, end.time, end.wall_s.front().second,
                                moves ? "energy residual" : "heat residual", end.energy_residual,
                                moves ? "work" : "heat moved"));
  if (options_.profile) observer_.outcome(profile_table(end));
  if (in_folder) observer_.outcome("report: " + report.string());
}
template<int dim> std::optional<DivergenceError> Simulation<dim>::run_on() {
  try {
    loop();
    return std::nullopt;
  } catch (const DivergenceError& error) { return error; } catch (const GeometryError& error) {
    return lost_reference(solver_, error);
  }
}
template<int dim> void Simulation<dim>::loop() {
  if (control_.limit() == 0.0) watch_.time("step", [&] { refresh_step(); });
  while (true) {
    watch_.time("output", [&] {
      unload();
      record_due();
    });
    if (at_end()) check_finite(solver_.state());
    judge_energy();
    if (finished()) {
      look_around();
      return;
    }
    check_reserve();
    const State<dim>& state = solver_.state();
    const Request request = observer_.request();
    const bool stopped = request.kind == Request::Kind::stop;
    if (stopped || request.kind == Request::Kind::checkpoint || checkpoints_.due(state.step, state.time)) {
      check_finite(state);
      watch_.time("output", [&] {
        watch_.time("output.disk", [&] { files_.wait(); }); // a checkpoint counts on the frames before it
        watch_.time("output.checkpoint", [&] { write_checkpoint(frames()); });
      });
    }
    if (stopped)
      return stop(Exit::interrupted,
                  fmt::format("by {} at {}{}", request.by, last_checkpoint_,
                              options_.output.empty() ? ""
                                                      : fmt::format("; `cnem restart {}` goes on from there",
                                                                    options_.output.string())));
    if (request.kind == Request::Kind::pause) {
      stage_ = Stage::paused;
      return;
    }
    adapt_and_step();
    node_steps_ += solver_.updates();
  }
}
template<int dim> bool Simulation<dim>::finished() {
  const State<dim>& state = solver_.state();
  if (!at_end()) return false;
  if (state.time >= input_.time.end * (1.0 - 1e-9)) {
    stop(Exit::done, "reached the end of the run");
    return true;
  }
  watch_.time("output", [&] { record_last(); });
  judge_energy();
  stop(Exit::done, "reached time.max_steps");
  return true;
}
/// By the last row of the history.
template<int dim> void Simulation<dim>::judge_energy() const {
  check_energy(history_.last_residual(), history_.energy_scale(), input_.method.energy_tolerance,
               solver_.state());
}
template<int dim> void Simulation<dim>::record_due() {
  const State<dim>& state = solver_.state();
  const double tolerance = 1e-9 * input_.time.end;
  record(history_due_.due(state.time, tolerance), fields_due_.due(state.time, tolerance),
         pictures_due_.due(state.time, tolerance));
  observer_.progress({.time = state.time,
                      .end = input_.time.end,
                      .step = state.step,
                      .dt = state.step_before,
                      .nodes = static_cast<std::int64_t>(state.node.size())});
}
template<int dim> void Simulation<dim>::record_last() {
  const double now = solver_.state().time;
  record(history_due_.last() != now, fields_due_.last() != now, pictures_due_.last() != now);
}
template<int dim> bool Simulation<dim>::at_end() const {
  const State<dim>& state = solver_.state();
  return state.time >= input_.time.end * (1.0 - 1e-9) ||
         (input_.time.max_steps && state.step >= *input_.time.max_steps);
}

/// Springback belongs into the last frame: before it is recorded.
template<int dim> void Simulation<dim>::unload() {
  if (!at_end()) return;
  if (std::string reason = features_.unload(solver_); !reason.empty()) warn(input_.placed(reason));
}
template<int dim> void Simulation<dim>::record(bool history, bool fields, bool pictures) {
  if (history)
    watch_.time("output.history", [&] {
      history_.record(solver_);
      features_.record(solver_);
    });
  const bool in_folder = !options_.output.empty();
  if (in_folder &&
      (fields || pictures)) // pictures are drawn anew from their frames, where others of the series show more
    watch_.time("output.fields", [&] { fields_->record(files_, features_.snapshot(solver_)); });
  if (in_folder && pictures)
    watch_.time("output.pictures", [&] { features_.draw(files_, features_.snapshot(solver_)); });
  if (history || fields || pictures) observer_.recorded(history, fields || pictures);
}
template<int dim> void Simulation<dim>::adapt_and_step() {
  const State<dim>& state = solver_.state();
  retries_.look(state.time);
  const bool rereference =
      watch_.time("step", [&] { return renewal_.due(solver_, retries_.strain_share()); });
  const bool check = rereference ||
                     (state.step - last_check_) * solver_.sub_steps() >= input_.time.check_every ||
                     control_.outgrown(solver_);
  if (check) // before nodes are put on facets, where contact has yet to find them
    watch_.time("step", [&] { watch_.time("step.stable", [&] { look_around(); }); });
  bool good = retries_.lacks_state();
  if (rereference || good)
    watch_.time("rebuild", [&] {
      retries_.take(state.time, [&](Archive& archive) { archive_course(archive, frames()); });
      if (rereference) good = new_reference();
    });
  watch_.time("step", [&] {
    if (check) watch_.time("step.stable", [&] { look_at_step(); });
    if (good) retries_.keep();
    solver_.advance(
        control_.choose(state.time, std::min({input_.time.end, fields_due_.next(), pictures_due_.next()})));
    features_.add_step(solver_);
  });
}
template<int dim> bool Simulation<dim>::new_reference() {
  double changed = 1.0;
  const auto prepare = [&] {
    changed = features_.renew(solver_, [&](const Resampling<dim>& change) { follow(change); });
  };
  if (!renewal_.renew(solver_, prepare, retries_.strain_share())) return false;
  renewal_.rest(changed);
  return true;
}
/// What looks at material points goes with them.
template<int dim> void Simulation<dim>::follow(const Resampling<dim>& change) {
  history_.resample(change, solver_);
  lines_.resample(change, solver_.conditions().cloud, solver_.approximation());
}
template<int dim> void Simulation<dim>::look_at_step() {
  check_finite(solver_.state());
  refresh_step();
  last_check_ = solver_.state().step;
}
template<int dim> void Simulation<dim>::look_around() {
  melting_.look(solver_);
  penetration_.look(solver_);
  measured_range_.look(solver_);
  mass_balance_.look(solver_);
}
template<int dim> void Simulation<dim>::refresh_step() { control_.refresh(solver_); }
template<int dim> void Simulation<dim>::stop(Exit exit, std::string reason) {
  exit_ = exit;
  reason_ = std::move(reason);
}
template<int dim> void Simulation<dim>::diverge(const DivergenceError& error) {
  dead_ = post_mortem(error, input_, solver_);
  stop(Exit::diverged, dead_->text);
  if (const std::string warning = renewal_.warning(); !warning.empty())
    dead_->causes.push_back(fmt::format("Nodes have passed each other: {}.", warning));
  if (options_.output.empty()) return;
  dead_->last_good = fmt::format("{} is of {}; fields.pvd ends at t = {:.6g} s", results::files::checkpoint,
                                 last_checkpoint_.empty() ? "no step" : last_checkpoint_, fields_due_.last());
  if (error.node >= 0) dead_->picture = features_.draw_place(files_, solver_, index_of(error.node));
}
template<int dim> Exit Simulation<dim>::fail(const std::string& message) {
  forget_last_words();
  observer_.steps_end();
  stage_ = Stage::ended;
  watch_.pause();
  stop(Exit::io_failed, message);
  const std::string how = how_to_go_on();
  observer_.failure(how.empty() ? message : fmt::format("{}\n{}", message, how));
  try {
    if (!options_.output.empty()) results::write_status(options_.output, status());
  } catch (const std::exception&) {} // there may be no room for this either
  return Exit::io_failed;
}
template<int dim> std::vector<std::string> Simulation<dim>::late_warnings() const {
  std::vector<std::string> list{melting_.warning(),      penetration_.warning(),
                                retries_.warning(),      renewal_.warning(),
                                mass_balance_.warning(), history_.kinetic_warning(input_)};
  for (const std::string& warning : measured_range_.warnings()) list.push_back(warning);
  std::erase(list, "");
  for (std::string& warning : list) warning = input_.placed(warning);
  return list;
}
template<int dim> void Simulation<dim>::add_step_times(Stopwatch& watch) const {
  const StepTimes& step = solver_.times();
  watch.add("step.motion", step.motion);
  watch.add("step.contact", step.contact);
  watch.add("step.stress", step.stress);
  watch.add("step.forces", step.forces);
  watch.add("step.heat", step.heat);
}
template<int dim> std::vector<std::pair<std::string, double>> Simulation<dim>::wall() const {
  Stopwatch watch = watch_;
  add_step_times(watch);
  return watch.spent();
}
template<int dim> results::RunStatus Simulation<dim>::status() {
  const State<dim>& state = solver_.state();
  results::RunStatus status;
  status.exit = exit_;
  status.reason = reason_;
  status.version = options_.version;
  status.case_name = input_.name;
  status.time = state.time;
  status.steps = state.step;
  status.nodes = static_cast<std::int64_t>(state.node.size());
  status.points = static_cast<std::int64_t>(state.point.size());
  status.node_steps = static_cast<std::int64_t>(node_steps_);
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = results::peak_rss_bytes();
  status.energy_residual =
      input_.analysis.mechanical ? history_.energy_residual() : results::heat_residual_share(solver_);
  for (const auto& [name, value] : history_.metrics()) status.add_metric(name, value);
  status.add_metric("references", solver_.references());
  status.add_metric("retries", retries_.count());
  for (const auto& [name, value] : features_.metrics()) status.add_metric(name, value);
  status.flags = features_.flags();
  status.step_limits = control_.shares();
  status.warnings = warnings_;
  for (std::string& warning : late_warnings()) status.warnings.push_back(std::move(warning));
  status.post_mortem = dead_;
  status.wall_s = wall();
  status.cpu_s = watch_.cpu();
  return status;
}

template void refuse_snap_back(const input::Case&, const ExplicitSolver<2>&);
template void refuse_snap_back(const input::Case&, const ExplicitSolver<3>&);
template ExplicitSolver<2> make_solver(const input::Case&, std::vector<std::string>&);
template ExplicitSolver<3> make_solver(const input::Case&, std::vector<std::string>&);
template class Simulation<2>;
template class Simulation<3>;

} // namespace cnem::app
