#include "app/statics.hpp"

#include "app/fields.hpp"
#include "app/picture_recorder.hpp"
#include "app/profile.hpp"
#include "app/recorder.hpp"
#include "app/static_model.hpp"
#include "app/stopwatch.hpp"
#include "core/error.hpp"
#include "io/output_folder.hpp"
#include "io/report.hpp"
#include "io/status.hpp"
#include "mechanics/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <omp.h>

namespace cnem::app {

namespace {

/// Spread of K over the rings beyond which the result is doubted.
constexpr double path_tolerance = 0.01;

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

void write_history(const StaticModel& model, const StaticSolution& solution, const Snapshot& shot,
                   const std::filesystem::path& folder) {
  const HistoryUnits units = history_units(model.input);
  std::vector<std::pair<std::string, double>> row{{"time[s]", model.input.time.end},
                                                  {"step", 0.0},
                                                  {"dt[s]", 0.0},
                                                  {"nodes", static_cast<double>(model.position[0].size())}};
  const auto& supports = model.setup.model.supports;
  for (std::size_t s = 0; s < supports.list().size(); ++s) {
    const std::string& name = supports.list()[s].name;
    if (s > 0 && supports.list()[s - 1].name == name) continue;
    Vec2 force = Vec2::Zero();
    for (const auto& p : supports.prescribed()) {
      if (supports.list()[static_cast<std::size_t>(p.support)].name != name) continue;
      const auto i = static_cast<std::size_t>(p.node);
      force += p.direction.dot(Vec2(solution.reaction[0][i], solution.reaction[1][i])) * p.direction;
    }
    row.emplace_back("support." + name + ".force_x" + units.force, force.x());
    row.emplace_back("support." + name + ".force_y" + units.force, force.y());
  }
  row.emplace_back("energy.elastic" + units.energy, solution.strain_energy);
  row.emplace_back("energy.stabilisation" + units.energy, solution.stabilisation_energy);
  row.emplace_back("energy.external_work" + units.energy, solution.external_work);
  row.emplace_back("energy.residual" + units.energy,
                   solution.strain_energy + solution.stabilisation_energy - solution.external_work);
  double mass = 0.0;
  for (const double m : shot.state.node.mass) mass += m;
  row.emplace_back("mass" + units.mass, mass);
  row.emplace_back("area[m^2]", boundary_area(shot));
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : row) {
    names.push_back(name);
    values.push_back(value);
  }
  io::HistoryWriter(folder / io::files::history, names).write(values);
}

io::RunStatus make_status(const StaticModel& model, const StaticSolution& solution,
                          const std::vector<TipResult>& tips, const RunOptions& options) {
  io::RunStatus status;
  status.exit = Exit::done;
  status.reason = "solved";
  status.version = options.version;
  status.case_name = model.input.name;
  status.time = model.input.time.end;
  status.nodes = static_cast<std::int64_t>(model.position[0].size());
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = io::peak_rss_bytes();
  status.energy_residual = solution.residual;
  status.warnings = model.setup.warnings;
  for (const std::string& warning : closed_cracks(model, solution)) status.warnings.push_back(warning);
  for (const TipResult& tip : tips) {
    status.metrics.emplace_back("K_I." + tip.name, tip.intensity.K_I);
    status.metrics.emplace_back("K_II." + tip.name, tip.intensity.K_II);
    status.metrics.emplace_back("K_spread." + tip.name, tip.spread);
    if (tip.spread > path_tolerance)
      status.warnings.push_back(fmt::format(
          "the stress intensity at tip '{}' changes by {:.2g}% from domain to domain: refine the cloud "
          "at the tip, or set fracture.integral",
          tip.name, 100.0 * tip.spread));
  }
  status.metrics.emplace_back("strain_energy", solution.strain_energy);
  status.metrics.emplace_back("stabilisation_energy", solution.stabilisation_energy);
  status.metrics.emplace_back("external_work", solution.external_work);
  status.metrics.emplace_back("largest_displacement", largest_displacement(model, solution));
  status.metrics.emplace_back("condition_number", solution.condition);
  status.metrics.emplace_back("enriched_nodes", model.enriched.enriched_nodes());
  return status;
}

} // namespace

Exit run_static(const io::Case& input, const RunOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  Stopwatch watch;
  const StaticModel model = watch.time("setup", [&] { return StaticModel(input); });
  io::prepare_output_folder(options.output, options.force);
  io::write_atomically(options.output / io::files::resolved_case, input.resolved);
  for (const std::string& warning : model.setup.warnings) fmt::print(stderr, "warning: {}\n", warning);

  const StaticSolution solution = watch.time("step", [&] {
    try {
      return solve_statics(model.problem());
    } catch (const InputError& error) { throw input.error("boundary", error.what()); }
  });
  const std::vector<TipResult> tips = evaluate_tips(model, solution);
  const State<2> state = as_state(model, solution);
  const Snapshot shot{state,
                      model.approximation,
                      model.position,
                      model.setup.model.cloud,
                      model.setup.model.contact,
                      nullptr,
                      drawing_scale(model, solution)};
  watch.time("output", [&] {
    io::FileQueue files;
    watch.time("output.history", [&] { write_history(model, solution, shot, options.output); });
    write_lines(input, shot, options.output);
    watch.time("output.fields", [&] { FieldRecorder(options.output).record(files, shot); });
    watch.time("output.pictures", [&] { PictureRecorder(input, options.output).record(files, shot); });
    watch.time("output.disk", [&] { files.wait(); });
  });
  io::RunStatus status = make_status(model, solution, tips, options);
  status.wall_s = watch.spent();
  const std::filesystem::path report = watch.time("output", [&] {
    return watch.time("output.report", [&] { return io::write_report(options.output, status); });
  });
  status.wall_s = watch.spent();
  io::write_status(options.output, status);
  for (std::size_t w = model.setup.warnings.size(); w < status.warnings.size(); ++w)
    fmt::print(stderr, "warning: {}\n", status.warnings[w]);
  for (const TipResult& tip : tips)
    fmt::print("tip {}: K_I = {:.6g}, K_II = {:.6g} Pa m^0.5 within {:.2g}%\n", tip.name, tip.intensity.K_I,
               tip.intensity.K_II, 100.0 * tip.spread);
  fmt::print("done: {} nodes in {:.2f} s; equilibrium to {:.1g}\n", status.nodes,
             status.wall_s.front().second, solution.residual);
  if (options.profile) fmt::print("{}", profile_table(status));
  fmt::print("report: {}\n", report.string());
  return Exit::done;
}

void check_static(const io::Case& input, const RunOptions& options) {
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
        tip.name, tip.position.x(), tip.position.y(), tip.spacing, model.enrichment_radius[t], ring.inner,
        ring.outer);
  }
  const std::string motion =
      missing_support(model.enriched.operators, model.setup.model.cloud.position, model.setup.model.supports);
  if (motion.empty()) fmt::print("supports    hold all rigid motions\n");
  StaticSolution nothing;
  resize_all(nothing.displacement, static_cast<std::size_t>(model.enriched.operators.nodes));
  resize_all(nothing.gradient, static_cast<std::size_t>(model.enriched.operators.points));
  resize_all(nothing.stress, static_cast<std::size_t>(model.enriched.operators.points));
  const State<2> state = as_state(model, nothing);
  const std::filesystem::path folder = options.output / "initial";
  io::prepare_output_folder(folder, true);
  io::FileQueue files;
  FieldRecorder(folder).record(files, {state, model.approximation, model.position, model.setup.model.cloud,
                                       model.setup.model.contact});
  files.wait();
  fmt::print("fields      {}\n", (folder / io::files::fields).string());
  if (!motion.empty()) throw input.error("boundary", motion);
}

} // namespace cnem::app
