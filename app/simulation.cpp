#include "app/simulation.hpp"

#include "app/blanking.hpp"
#include "app/profile.hpp"
#include "app/registry.hpp"
#include "app/run_signals.hpp"
#include "core/isa.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/output_folder.hpp"
#include "io/report.hpp"

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

bool CheckpointTimer::due(const State<2>& state) const {
  return step_ < 0 || (control_->every_steps > 0 && state.step >= step_ + control_->every_steps) ||
         (control_->every_time > 0.0 && state.time >= next_time_) ||
         (control_->every_wall > 0.0 && wall_time() >= wall_ + control_->every_wall);
}

void CheckpointTimer::written(const State<2>& state) {
  step_ = state.step;
  wall_ = wall_time();
  if (control_->every_time > 0.0)
    next_time_ = (std::floor(state.time / control_->every_time) + 1.0) * control_->every_time;
}

ExplicitSolver<2> make_solver(const io::Case& input, std::vector<std::string>& warnings) {
  Setup setup = build(input);
  warnings = std::move(setup.warnings);
  try {
    return {std::move(setup.model), std::move(setup.velocity), std::move(setup.temperature)};
  } catch (const GeometryError& error) { throw input.error("domain", error.what()); }
}

Simulation::Simulation(const io::Case& input, const RunOptions& options)
    : input_(input), options_(options),
      solver_(watch_.time("setup", [&] { return make_solver(input, warnings_); })),
      history_(input, solver_, options.output),
      history_due_(every(input.output.history_every, input.time.end, Schedule::every_step())),
      fields_due_(every(input.output.fields_every, input.time.end,
                        Schedule::at({0.0, input.time.end}, input.time.end))),
      pictures_due_(Schedule::at(input.output.pictures, input.time.end)), control_(input.time),
      renewal_(input.method), adaptation_(input, solver_), checkpoints_(input.output.checkpoint) {}

void Simulation::start() {
  adaptation_.start_log(options_.output);
  watch_.time("rebuild", [&] {
    adaptation_.fit_to_tools(solver_,
                             [&](const Resampling<2>& change) { history_.resample(change, solver_); });
  });
  fields_.emplace(options_.output);
  pictures_.emplace(input_, options_.output);
}

void Simulation::resume(io::CheckpointReader& checkpoint) {
  archive(checkpoint);
  const double now = solver_.state().time;
  int frames = 0;
  checkpoint.integer("run/frames", frames);
  fields_.emplace(options_.output, now);
  if (fields_->frames() != frames)
    throw IoError(fmt::format("{} has {} of the {} frames written until then",
                              (options_.output / io::files::fields).string(), fields_->frames(), frames));
  history_.resume(solver_);
  adaptation_.resume_log(options_.output);
  pictures_.emplace(input_, options_.output);
  pictures_->truncate(now);
  checkpoints_.written(solver_.state());
  last_checkpoint_ = fmt::format("step {}, t = {:.6g} s", solver_.state().step, now);
}

void Simulation::archive(Archive& archive) {
  solver_.archive(archive);
  history_due_.archive(archive, "run/due/history");
  fields_due_.archive(archive, "run/due/fields");
  pictures_due_.archive(archive, "run/due/pictures");
  control_.archive(archive);
  renewal_.archive(archive);
  adaptation_.archive(archive);
  history_.archive(archive);
  archive.integer("run/last_check", last_check_);
  archive.number("run/node_steps", "1", node_steps_);
  for (auto [phase, seconds] : wall()) {
    archive.number(fmt::format("run/wall/{}", phase), "s", seconds);
    if (archive.loading()) watch_.add(phase, seconds);
  }
}

Exit Simulation::run() {
  for (const std::string& warning : warnings_) progress_.message("warning: " + warning);
  try {
    try {
      loop();
    } catch (const DivergenceError& error) { diverge(error); } catch (const GeometryError& error) {
      diverge(lost_reference(solver_, error));
    }
    watch_.time("output", [&] {
      if (exit_ != Exit::interrupted) write_lines(input_, snapshot(solver_), options_.output);
      watch_.time("output.disk", [&] { files_.wait(); });
      evaluate();
    });
    progress_.finish();
    if (const std::string warning = renewal_.warning(); !warning.empty())
      progress_.message("warning: " + warning);
    if (const std::string warning = history_.kinetic_warning(input_); !warning.empty())
      progress_.message("warning: " + warning);
    io::RunStatus end = status();
    const std::filesystem::path report = watch_.time("output", [&] {
      return watch_.time("output.report", [&] { return io::write_report(options_.output, end); });
    });
    end.wall_s = wall();
    io::write_status(options_.output, end);
    fmt::print("{}: {}\n",
               exit_ == Exit::done          ? "done"
               : exit_ == Exit::interrupted ? "stopped"
                                            : "diverged",
               reason_);
    fmt::print("{} nodes, {} steps to t = {:.4g} s in {:.1f} s; energy residual {:.2g} of the work\n",
               end.nodes, end.steps, end.time, end.wall_s.front().second, end.energy_residual);
    if (options_.profile) fmt::print("{}", profile_table(end));
    fmt::print("report: {}\n", report.string());
    return exit_;
  } catch (const IoError& error) {
    return fail(error.what());
  } catch (const std::filesystem::filesystem_error& error) { return fail(error.what()); }
}

void Simulation::loop() {
  if (control_.limit() == 0.0) watch_.time("step", [&] { control_.refresh(solver_); });
  while (true) {
    watch_.time("output", [&] {
      let_go();
      record_due();
    });
    if (finished()) return;
    const State<2>& state = solver_.state();
    check_energy(history_.last_residual(), history_.energy_scale(), input_.method.energy_tolerance, state);
    const char* signal = RunSignals::stop();
    if (RunSignals::take_checkpoint() || signal || checkpoints_.due(state)) {
      check_finite(state);
      watch_.time("output", [&] {
        watch_.time("output.disk", [&] { files_.wait(); }); // a checkpoint counts on the frames before it
        watch_.time("output.checkpoint", [&] { write_checkpoint(); });
      });
    }
    if (signal)
      return stop(Exit::interrupted, fmt::format("by {} at {}; `cnem restart {}` goes on from there", signal,
                                                 last_checkpoint_, options_.output.string()));
    adapt_and_step();
    node_steps_ += solver_.updates();
  }
}

bool Simulation::finished() {
  const State<2>& state = solver_.state();
  if (!at_end()) return false;
  if (state.time >= input_.time.end * (1.0 - 1e-9)) {
    stop(Exit::done, "reached the end of the run");
    return true;
  }
  watch_.time("output", [&] { record_last(); });
  stop(Exit::done, "reached time.max_steps");
  return true;
}

void Simulation::record_due() {
  const State<2>& state = solver_.state();
  const double tolerance = 1e-9 * input_.time.end;
  record(history_due_.due(state.time, tolerance), fields_due_.due(state.time, tolerance),
         pictures_due_.due(state.time, tolerance));
  progress_.update({.time = state.time,
                    .end = input_.time.end,
                    .step = state.step,
                    .dt = state.step_before,
                    .nodes = static_cast<std::int64_t>(state.node.size())});
}

void Simulation::record_last() {
  const double now = solver_.state().time;
  record(history_due_.last() != now, fields_due_.last() != now, pictures_due_.last() != now);
}

Snapshot Simulation::shot() {
  Snapshot shot = snapshot(solver_);
  if (adaptation_.active()) {
    adaptation_fields_ = adaptation_.fields(solver_.state().time);
    shot.adaptation = &adaptation_fields_;
  }
  if (springback_) shot.springback = &springback_->displacement;
  return shot;
}

bool Simulation::at_end() const {
  const State<2>& state = solver_.state();
  return state.time >= input_.time.end * (1.0 - 1e-9) ||
         (input_.time.max_steps && state.step >= *input_.time.max_steps);
}

/// Springback belongs into the last frame: before it is recorded.
void Simulation::let_go() {
  if (!input_.report.springback || !at_end()) return;
  const Model<2>& model = solver_.model();
  const State<2>& state = solver_.state();
  check_finite(state);
  try {
    springback_ = springback({solver_.approximation(), state.point, state.node.position, state.node.mass,
                              model.materials, model.supports, model.stabilisation});
  } catch (const InputError& error) { warn(fmt::format("there is no springback: {}", error.what())); }
}

void Simulation::evaluate() {
  if (exit_ != Exit::done || !(input_.report.blanking || springback_)) return;
  blanking_ =
      evaluate_blanking(input_, shot(), solver_.model().supports, springback_ ? &*springback_ : nullptr,
                        io::read_history(options_.output / io::files::history));
  io::write_blanking(options_.output, *blanking_);
}

void Simulation::record(bool history, bool fields, bool pictures) {
  if (history) watch_.time("output.history", [&] { history_.record(solver_); });
  if (fields) watch_.time("output.fields", [&] { fields_->record(files_, shot()); });
  if (pictures) watch_.time("output.pictures", [&] { pictures_->record(files_, shot()); });
}

void Simulation::adapt_and_step() {
  const bool rereference = watch_.time("step", [&] { return renewal_.due(solver_); });
  if (rereference) watch_.time("rebuild", [&] { new_reference(); });
  watch_.time("step", [&] {
    const State<2>& state = solver_.state();
    if (rereference || (state.step - last_check_) * solver_.sub_steps() >= input_.time.check_every)
      watch_.time("step.stable", [&] { look_at_step(); });
    solver_.advance(
        control_.choose(state.time, std::min({input_.time.end, fields_due_.next(), pictures_due_.next()})));
  });
}

void Simulation::new_reference() {
  renewal_.renew(solver_, [&] {
    if (adaptation_.active())
      adaptation_.renew(solver_, [&](const Resampling<2>& change) { history_.resample(change, solver_); });
    else
      solver_.prepare();
  });
}

void Simulation::look_at_step() {
  check_finite(solver_.state());
  control_.refresh(solver_);
  last_check_ = solver_.state().step;
}

void Simulation::write_checkpoint() {
  const State<2>& state = solver_.state();
  io::flush_file(options_.output /
                 io::files::history); // what the checkpoint counts on must not be lost before it
  io::CheckpointWriter writer;
  io::CheckpointInfo info{options_.version, std::string(isa_name(active_isa())),
                          input_.name,      io::hash_of_inputs(input_.resolved),
                          state.step,       state.time};
  info.archive(writer);
  archive(writer);
  int frames = fields_->frames();
  writer.integer("run/frames", frames);
  io::add_checkpoint(options_.output, writer.content(), input_.output.checkpoint.keep);
  checkpoints_.written(state);
  last_checkpoint_ = fmt::format("step {}, t = {:.6g} s", state.step, state.time);
}

void Simulation::stop(Exit exit, std::string reason) {
  exit_ = exit;
  reason_ = std::move(reason);
}

void Simulation::diverge(const DivergenceError& error) {
  stop(Exit::diverged, error.what());
  dead_ = post_mortem(error, input_, solver_);
  if (const std::string warning = renewal_.warning(); !warning.empty())
    dead_->causes.push_back(fmt::format("Nodes have passed each other: {}.", warning));
  dead_->last_good = fmt::format("{} is of {}; fields.pvd ends at t = {:.6g} s", io::files::checkpoint,
                                 last_checkpoint_.empty() ? "no step" : last_checkpoint_, fields_due_.last());
  const Place place = place_of(solver_, static_cast<std::size_t>(error.node));
  dead_->picture = pictures_->record_place(files_, shot(), place.centre, place.radius);
}

Exit Simulation::fail(const std::string& message) {
  progress_.finish();
  stop(Exit::io_failed, message);
  fmt::print(stderr, "{}\n", message);
  if (!last_checkpoint_.empty())
    fmt::print(stderr,
               "the last checkpoint is of {}: once this is mended, `cnem restart {}` goes on from it\n",
               last_checkpoint_, options_.output.string());
  try {
    io::write_status(options_.output, status());
  } catch (const IoError&) {} // there may be no room for this either
  return Exit::io_failed;
}

std::vector<std::pair<std::string, double>> Simulation::wall() const {
  Stopwatch watch = watch_;
  const StepTimes& step = solver_.times();
  watch.add("step.motion", step.motion);
  watch.add("step.contact", step.contact);
  watch.add("step.stress", step.stress);
  watch.add("step.forces", step.forces);
  watch.add("step.heat", step.heat);
  return watch.spent();
}

io::RunStatus Simulation::status() {
  const State<2>& state = solver_.state();
  io::RunStatus status;
  status.exit = exit_;
  status.reason = reason_;
  status.version = options_.version;
  status.case_name = input_.name;
  status.time = state.time;
  status.steps = state.step;
  status.nodes = static_cast<std::int64_t>(state.node.size());
  status.node_steps = static_cast<std::int64_t>(node_steps_);
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = io::peak_rss_bytes();
  status.energy_residual = history_.energy_residual();
  status.metrics = history_.metrics();
  status.metrics.emplace_back("references", solver_.references());
  for (const auto& metric : adaptation_.metrics()) status.metrics.push_back(metric);
  if (blanking_) {
    if (!blanking_->punch.empty())
      for (const auto& metric : io::metrics_of(*blanking_)) status.metrics.push_back(metric);
    if (!blanking_->springback.empty())
      for (const auto& metric : io::metrics_of(blanking_->springback)) status.metrics.push_back(metric);
  }
  status.step_limits = control_.shares();
  status.warnings = warnings_;
  if (const std::string warning = renewal_.warning(); !warning.empty()) status.warnings.push_back(warning);
  if (const std::string warning = history_.kinetic_warning(input_); !warning.empty())
    status.warnings.push_back(warning);
  status.post_mortem = dead_;
  status.wall_s = wall();
  return status;
}

} // namespace cnem::app
