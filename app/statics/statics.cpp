#include "app/statics/statics.hpp"

#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "app/statics/static_model.hpp"
#include "app/stopwatch.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "report/picture_recorder.hpp"
#include "report/report.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/recorder.hpp"
#include "results/sample_lines.hpp"
#include "results/status.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <omp.h>

namespace cnem::app {

namespace {

double largest_displacement(const StaticModel& model, const StaticSolution& solution) {
  double most = 0.0;
  for (std::size_t i = 0; i < model.position[0].size(); ++i)
    most = std::max(most, std::hypot(solution.displacement[0][i], solution.displacement[1][i]));
  return most;
}

/// Largest displacements are drawn as at most 5% of the size of the body, and never enlarged less than true.
double drawing_scale(const StaticModel& model, const StaticSolution& solution) {
  double size = 0.0;
  for (const Field& x : model.position) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    size = std::max(size, *high - *low);
  }
  const double most = largest_displacement(model, solution);
  return most > 0.0 ? 0.05 * size / most : 1.0;
}

void write_history(const StaticModel& model, const StaticSolution& solution, const results::Snapshot<2>& shot,
                   const std::filesystem::path& folder) {
  const results::HistoryUnits units = results::history_units(model.input.analysis);
  std::vector<std::pair<std::string, double>> row{{"time[s]", model.input.time.end},
                                                  {"step", 0.0},
                                                  {"dt[s]", 0.0},
                                                  {"nodes", static_cast<double>(model.position[0].size())}};
  const auto& supports = model.setup.problem.supports;
  for (std::size_t s = 0; s < supports.list().size(); ++s) {
    const std::string& name = supports.list()[s].name;
    if (s > 0 && supports.list()[s - 1].name == name) continue;
    Vec2 force = Vec2::Zero();
    for (const auto& p : supports.prescribed()) {
      if (supports.list()[index_of(p.support)].name != name) continue;
      const auto i = index_of(p.node);
      force += p.direction.dot(Vec2(solution.reaction[0][i], solution.reaction[1][i])) * p.direction;
    }
    row.emplace_back("support." + name + ".force_x" + units.force, force.x());
    row.emplace_back("support." + name + ".force_y" + units.force, force.y());
  }
  row.emplace_back("energy.elastic" + units.energy, solution.strain_energy);
  row.emplace_back("energy.stabilisation" + units.energy, solution.stabilisation_energy);
  row.emplace_back("energy.external_work" + units.energy, solution.external_work);
  row.emplace_back("energy.thermal_expansion" + units.energy, solution.thermal_work);
  row.emplace_back("energy.residual" + units.energy, solution.strain_energy + solution.stabilisation_energy -
                                                         solution.external_work - solution.thermal_work);
  double mass = 0.0;
  for (const double m : shot.state.node.mass) mass += m;
  row.emplace_back("mass" + units.mass, mass);
  row.emplace_back(units.enclosed + units.measure, results::enclosed_measure(shot));
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : row) {
    names.push_back(name);
    values.push_back(value);
  }
  results::HistoryWriter(folder / results::files::history, names).write(values);
}

/// Without what comes of the solution.
results::RunStatus blank_status(const StaticModel& model, const RunOptions& options) {
  results::RunStatus status;
  status.version = options.version;
  status.case_name = model.input.name;
  status.time = model.input.time.end;
  status.nodes = static_cast<std::int64_t>(model.position[0].size());
  status.points = model.enriched.operators.points;
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = results::peak_rss_bytes();
  status.warnings = model.setup.warnings;
  return status;
}

results::RunStatus make_status(const StaticModel& model, const StaticSolution& solution,
                               const std::vector<TipResult>& tips, const RunOptions& options) {
  results::RunStatus status = blank_status(model, options);
  const results::HistoryUnits units = results::history_units(model.input.analysis);
  status.exit = Exit::done;
  status.reason = "solved";
  status.energy_residual = solution.residual;
  for (const std::string& warning : closed_cracks(model, solution))
    status.warnings.push_back(model.input.placed(warning));
  if (std::string text = beyond_yield(model, solution); !text.empty())
    status.warnings.push_back(std::move(text));
  for (const TipResult& tip : tips) {
    status.add_metric("K_I." + tip.name + "[Pa m^0.5]", tip.intensity.K_I);
    status.add_metric("K_II." + tip.name + "[Pa m^0.5]", tip.intensity.K_II);
    status.add_metric("K_spread." + tip.name, tip.spread);
    if (std::string text = doubt(tip); !text.empty()) status.warnings.push_back(std::move(text));
  }
  status.add_metric("strain_energy" + units.energy, solution.strain_energy);
  status.add_metric("stabilisation_energy" + units.energy, solution.stabilisation_energy);
  status.add_metric("external_work" + units.energy, solution.external_work);
  status.add_metric("largest_displacement[m]", largest_displacement(model, solution));
  status.add_metric("condition_number", solution.condition);
  status.add_metric("enriched_nodes", model.enriched.enriched_nodes());
  return status;
}

/// The status and report of a solution that means nothing: there are no fields to show.
Exit give_up(const StaticModel& model, const DivergenceError& error, const RunOptions& options,
             const Stopwatch& watch) {
  const input::Case& input = model.input;
  results::RunStatus status = blank_status(model, options);
  status.exit = Exit::diverged;
  results::PostMortem& dead = status.post_mortem.emplace();
  dead.time = input.time.end;
  dead.node = error.node;
  dead.field = error.field;
  dead.text = status.reason = input.placed(error.what());
  dead.causes.push_back(
      "Loads, prescribed displacements or elastic constants are beyond anything physical: look at "
      "their units.");
  dead.last_good = "nothing was solved";
  if (error.node >= 0) {
    const Vec2 at = input.origin.head<2>() + model.setup.problem.cloud.position[index_of(error.node)];
    dead.x = at.x();
    dead.y = at.y();
  }
  status.wall_s = watch.spent();
  status.cpu_s = watch.cpu();
  results::write_status(options.output, status);
  fmt::print("diverged: {}\nreport: {}\n", status.reason,
             report::write_report(options.output, status).string());
  return Exit::diverged;
}

Exit solve(const StaticModel& model, const RunOptions& options, Stopwatch& watch) {
  const input::Case& input = model.input;
  for (const std::string& warning : model.setup.warnings) fmt::print(stderr, "warning: {}\n", warning);

  StaticSolution solution;
  std::vector<TipResult> tips;
  try {
    solution = watch.time("step", [&] {
      try {
        return solve_statics(model.problem());
      } catch (const InputError& error) { throw input.error("boundary", error.what()); }
    });
    tips = evaluate_tips(model, solution);
  } catch (const DivergenceError& error) { return give_up(model, error, options, watch); }
  const State<2> state = as_state(model, solution);
  const results::Snapshot<2> shot{
      state,   model.approximation,           model.setup.problem.cloud, model.setup.problem.contact,
      nullptr, drawing_scale(model, solution)};
  watch.time("output", [&] {
    results::FileQueue files;
    watch.time("output.history", [&] { write_history(model, solution, shot, options.output); });
    results::SampleLines<2>(input, shot.cloud, model.approximation).write(shot, options.output);
    watch.time("output.fields", [&] { results::FieldRecorder(options.output, input).record(files, shot); });
    watch.time("output.pictures",
               [&] { report::PictureRecorder(input, options.output).record(files, shot); });
    watch.time("output.disk", [&] { files.wait(); });
  });
  results::RunStatus status = make_status(model, solution, tips, options);
  status.wall_s = watch.spent();
  status.cpu_s = watch.cpu();
  const std::filesystem::path report = watch.time("output", [&] {
    return watch.time("output.report", [&] { return report::write_report(options.output, status); });
  });
  status.wall_s = watch.spent();
  status.cpu_s = watch.cpu();
  results::write_status(options.output, status);
  for (std::size_t w = model.setup.warnings.size(); w < status.warnings.size(); ++w)
    fmt::print(stderr, "warning: {}\n", status.warnings[w]);
  for (const TipResult& tip : tips)
    fmt::print("tip {}: K_I = {:.6g}, K_II = {:.6g} Pa m^0.5; domains differ by {:.2g} Pa m^0.5 ({:.2g}%)\n",
               tip.name, tip.intensity.K_I, tip.intensity.K_II, tip.difference, 100.0 * tip.spread);
  fmt::print("done: {} nodes in {:.2f} s; equilibrium to {:.1g}\n", status.nodes,
             status.wall_s.front().second, solution.residual);
  if (options.profile) fmt::print("{}", profile_table(status));
  fmt::print("report: {}\n", report.string());
  return Exit::done;
}

} // namespace

Exit run_static(const input::Case& input, const RunOptions& options) {
  Stopwatch watch;
  const StaticModel model = watch.time("setup", [&] { return StaticModel(input); });
  results::prepare_output_folder(options.output, options.force);
  results::write_atomically(options.output / results::files::resolved_case, input.resolved);
  return before_steps(input, options, [&] { return solve(model, options, watch); });
}
void check_static(const input::Case& input, const RunOptions& options) {
  const StaticModel model(input);
  for (const std::string& warning : model.setup.warnings) fmt::print("warning: {}\n", warning);
  fmt::print("case        {}\n", input.title.empty() ? input.name : input.title);
  fmt::print("nodes       {}\n", model.position[0].size());
  fmt::print("points      {}\n", model.enriched.operators.points);
  fmt::print("unknowns    {}\n", 2 * model.enriched.operators.nodes);
  for (std::size_t t = 0; t < model.tips.size(); ++t) {
    const fracture::CrackTip& tip = model.tips[t];
    const fracture::Ring ring = rings(input.fracture, tip).back();
    fmt::print(
        "tip         {} at ({:.6g}, {:.6g}) m, spacing {:.3g} m, enriched within {:.3g} m, integral from "
        "{:.3g} to {:.3g} m\n",
        tip.name, input.origin.x() + tip.position.x(), input.origin.y() + tip.position.y(), tip.spacing,
        model.enrichment_radius[t], ring.inner, ring.outer);
  }
  const std::string motion = missing_support(model.enriched.operators, model.setup.problem.cloud.position,
                                             model.setup.problem.supports);
  if (motion.empty()) fmt::print("supports    hold all rigid motions\n");
  StaticSolution nothing;
  resize_all(nothing.displacement, index_of(model.enriched.operators.nodes));
  resize_all(nothing.gradient, index_of(model.enriched.operators.points));
  resize_all(nothing.stress, index_of(model.enriched.operators.points));
  const State<2> state = as_state(model, nothing);
  const std::filesystem::path folder = options.output / "initial";
  results::prepare_output_folder(folder, true);
  results::FileQueue files;
  const results::Snapshot<2> shot{state, model.approximation, model.setup.problem.cloud,
                                  model.setup.problem.contact};
  results::FieldRecorder(folder, input).record(files, shot);
  files.wait();
  fmt::print("fields      {}\n", (folder / results::files::fields).string());
  if (!motion.empty()) throw input.error("boundary", motion);
}

} // namespace cnem::app
