#include "app/statics/statics.hpp"

#include "app/process/exhaustion.hpp"
#include "app/profile.hpp"
#include "core/error.hpp"
#include "core/fields/vector_at.hpp"
#include "core/index.hpp"
#include "mechanics/statics/rigid_motion.hpp"
#include "report/picture_recorder.hpp"
#include "report/report.hpp"
#include "report/space_recorder.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/recorder.hpp"
#include "results/sample_lines.hpp"
#include "results/status.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <omp.h>
#include <type_traits>

namespace cnem::app {

namespace {

template<int dim>
double largest_displacement(const StaticModel<dim>& model, const StaticSolution<dim>& solution) {
  double most = 0.0;
  for (std::size_t i = 0; i < model.position[0].size(); ++i)
    most = std::max(most, vector_at<dim>(solution.displacement, i).stableNorm());
  return most;
}

/// Largest displacements are drawn as at most 5% of the size of the body, and never enlarged less than true.
template<int dim> double drawing_scale(const StaticModel<dim>& model, const StaticSolution<dim>& solution) {
  double size = 0.0;
  for (const Field& x : model.position) {
    const auto [low, high] = std::minmax_element(x.begin(), x.end());
    size = std::max(size, *high - *low);
  }
  const double most = largest_displacement(model, solution);
  return most > 0.0 ? 0.05 * size / most : 1.0;
}

template<int dim> StaticSolution<dim> at_rest(const StaticModel<dim>& model) {
  StaticSolution<dim> nothing;
  resize_all(nothing.displacement, index_of(model.operators().nodes));
  resize_all(nothing.gradient, index_of(model.operators().points));
  resize_all(nothing.stress, index_of(model.operators().points));
  return nothing;
}

} // namespace

template<int dim>
StaticRun<dim>::StaticRun(const input::Case& input, const RunOptions& options, RunObserver& observer)
    : input_(input), options_(options), observer_(observer),
      model_(watch_.time("setup", [&] { return StaticModel<dim>(input); })), solution_(at_rest(model_)),
      state_(as_state(model_, solution_)), history_(options.keep_history), status_(blank_status()) {
  if (!options_.output.empty()) {
    results::prepare_output_folder(options_.output, options_.force);
    results::write_atomically(options_.output / results::files::resolved_case, input.resolved);
  }
  watch_.pause();
}

template<int dim> results::Snapshot<dim> StaticRun<dim>::shot() const {
  return {state_,  model_.approximation, model_.setup.problem.cloud, model_.setup.problem.contact,
          nullptr, displacement_scale_};
}

template<int dim> void StaticRun<dim>::write_history() {
  const results::HistoryUnits units = results::history_units(input_.analysis);
  std::vector<std::pair<std::string, double>> row{{"time[s]", input_.time.end},
                                                  {"step", 0.0},
                                                  {"dt[s]", 0.0},
                                                  {"nodes", static_cast<double>(model_.position[0].size())}};
  const auto& supports = model_.setup.problem.supports;
  for (std::size_t s = 0; s < supports.list().size(); ++s) {
    const std::string& name = supports.list()[s].name;
    if (s > 0 && supports.list()[s - 1].name == name) continue;
    Vec<dim> force = Vec<dim>::Zero();
    for (const auto& p : supports.prescribed()) {
      if (supports.list()[index_of(p.support)].name != name) continue;
      force += p.direction.dot(vector_at<dim>(solution_.reaction, index_of(p.node))) * p.direction;
    }
    for (std::size_t k = 0; k < dim; ++k)
      row.emplace_back(fmt::format("support.{}.force_{}{}", name, "xyz"[k], units.force),
                       force[static_cast<Eigen::Index>(k)]);
  }
  row.emplace_back("energy.elastic" + units.energy, solution_.strain_energy);
  row.emplace_back("energy.stabilisation" + units.energy, solution_.stabilisation_energy);
  row.emplace_back("energy.external_work" + units.energy, solution_.external_work);
  row.emplace_back("energy.thermal_expansion" + units.energy, solution_.thermal_work);
  row.emplace_back("energy.residual" + units.energy, solution_.strain_energy +
                                                         solution_.stabilisation_energy -
                                                         solution_.external_work - solution_.thermal_work);
  double mass = 0.0;
  for (const double m : state_.node.mass) mass += m;
  row.emplace_back("mass" + units.mass, mass);
  row.emplace_back(units.enclosed + units.measure, results::enclosed_measure(shot()));
  std::vector<std::string> names;
  std::vector<double> values;
  for (const auto& [name, value] : row) {
    names.push_back(name);
    values.push_back(value);
  }
  history_.start(results::file_in(options_.output, results::files::history), names);
  history_.write(values);
}

/// Without what comes of the solution.
template<int dim> results::RunStatus StaticRun<dim>::blank_status() const {
  results::RunStatus status;
  status.version = options_.version;
  status.case_name = input_.name;
  status.time = input_.time.end;
  status.nodes = static_cast<std::int64_t>(model_.position[0].size());
  status.points = model_.operators().points;
  status.threads = omp_get_max_threads();
  status.peak_rss_bytes = results::peak_rss_bytes();
  status.warnings = model_.setup.warnings;
  return status;
}

template<int dim> void StaticRun<dim>::judge(const std::vector<TipResult>& tips) {
  const results::HistoryUnits units = results::history_units(input_.analysis);
  status_ = blank_status();
  status_.exit = Exit::done;
  status_.reason = "solved";
  status_.energy_residual = solution_.residual;
  if constexpr (dim == 2)
    for (const std::string& warning : closed_cracks(model_, solution_))
      status_.warnings.push_back(input_.placed(warning));
  if (std::string text = beyond_yield(model_, solution_); !text.empty())
    status_.warnings.push_back(std::move(text));
  for (const TipResult& tip : tips) {
    status_.add_metric("K_I." + tip.name + "[Pa m^0.5]", tip.intensity.K_I);
    status_.add_metric("K_II." + tip.name + "[Pa m^0.5]", tip.intensity.K_II);
    status_.add_metric("K_spread." + tip.name, tip.spread);
    if (std::string text = doubt(tip); !text.empty()) status_.warnings.push_back(std::move(text));
  }
  status_.add_metric("strain_energy" + units.energy, solution_.strain_energy);
  status_.add_metric("stabilisation_energy" + units.energy, solution_.stabilisation_energy);
  status_.add_metric("external_work" + units.energy, solution_.external_work);
  status_.add_metric("largest_displacement[m]", largest_displacement(model_, solution_));
  status_.add_metric("condition_number", solution_.condition);
  if constexpr (dim == 2) status_.add_metric("enriched_nodes", model_.cracks.enriched.enriched_nodes());
}

template<int dim> std::filesystem::path StaticRun<dim>::write_report() {
  const auto note_times = [&] {
    status_.wall_s = watch_.spent();
    status_.cpu_s = watch_.cpu();
  };
  note_times();
  if (options_.output.empty()) return {};
  const std::filesystem::path report = watch_.time("output", [&] {
    return watch_.time("output.report", [&] { return report::write_report(options_.output, status_); });
  });
  note_times();
  results::write_status(options_.output, status_);
  return report;
}

/// The status and report of a solution that means nothing: there are no fields to show.
template<int dim> void StaticRun<dim>::give_up(const DivergenceError& error) {
  status_ = blank_status();
  status_.exit = Exit::diverged;
  results::PostMortem& dead = status_.post_mortem.emplace();
  dead.time = input_.time.end;
  dead.node = error.node;
  dead.field = error.field;
  dead.text = status_.reason = input_.placed(error.what());
  dead.causes.push_back(
      "Loads, prescribed displacements or elastic constants are beyond anything physical: look at "
      "their units.");
  dead.last_good = "nothing was solved";
  if (error.node >= 0) {
    const Vec<dim> at =
        input_.origin.template head<dim>() + model_.setup.problem.cloud.position[NodeIndex{error.node}];
    dead.x = at.x();
    dead.y = at.y();
    if constexpr (dim == 3) dead.z = at.z();
  }
  const std::filesystem::path report = write_report();
  observer_.outcome("diverged: " + status_.reason);
  if (!report.empty()) observer_.outcome("report: " + report.string());
}

template<int dim> void StaticRun<dim>::write_files() {
  using Pictures = std::conditional_t<dim == 2, report::PictureRecorder, report::SpaceRecorder>;
  results::FileQueue files;
  results::SampleLines<dim>(input_, shot().cloud, model_.approximation).write(shot(), options_.output);
  watch_.time("output.fields",
              [&] { results::FieldRecorder(options_.output, input_).record(files, shot()); });
  watch_.time("output.pictures", [&] { Pictures(input_, options_.output).record(files, shot()); });
  watch_.time("output.disk", [&] { files.wait(); });
}

template<int dim> void StaticRun<dim>::solve() {
  for (const std::string& warning : model_.setup.warnings) observer_.remark("warning: " + warning);
  std::vector<TipResult> tips;
  try {
    solution_ = watch_.time("step", [&] {
      try {
        return solve_statics(model_.problem());
      } catch (const InputError& error) { throw input_.error("boundary", error.what()); }
    });
    if constexpr (dim == 2) tips = evaluate_tips(model_, solution_);
  } catch (const DivergenceError& error) { return give_up(error); }
  state_ = as_state(model_, solution_);
  displacement_scale_ = drawing_scale(model_, solution_);
  watch_.time("output", [&] {
    watch_.time("output.history", [&] { write_history(); });
    if (!options_.output.empty()) write_files();
  });
  judge(tips);
  const std::filesystem::path report = write_report();
  for (std::size_t w = model_.setup.warnings.size(); w < status_.warnings.size(); ++w)
    observer_.remark("warning: " + status_.warnings[w]);
  for (const TipResult& tip : tips)
    observer_.outcome(fmt::format(
        "tip {}: K_I = {:.6g}, K_II = {:.6g} Pa m^0.5; domains differ by {:.2g} Pa m^0.5 ({:.2g}%)", tip.name,
        tip.intensity.K_I, tip.intensity.K_II, tip.difference, 100.0 * tip.spread));
  observer_.outcome(fmt::format("done: {} nodes in {:.2f} s; equilibrium to {:.1g}", status_.nodes,
                                status_.wall_s.front().second, solution_.residual));
  if (options_.profile) observer_.outcome(profile_table(status_));
  if (!report.empty()) observer_.outcome("report: " + report.string());
  observer_.recorded(true, true);
}

template<int dim> std::optional<Exit> StaticRun<dim>::go_on() {
  if (!ended_) {
    watch_.go_on();
    before_steps(input_, options_, [&] { solve(); });
    watch_.pause();
    ended_ = true;
  }
  return static_cast<Exit>(status_.exit);
}

template<int dim> Checked check_static(const input::Case& input, const RunOptions& options) {
  const StaticModel<dim> model(input);
  Checked checked;
  checked.warnings = model.setup.warnings;
  const auto add = [&](const char* label, std::string text) {
    checked.facts.emplace_back(label, std::move(text));
  };
  const auto count = [&](const char* name, auto number) {
    add(name, fmt::format("{}", number));
    checked.numbers.emplace_back(name, static_cast<double>(number));
  };
  add("case", input.title.empty() ? input.name : input.title);
  count("nodes", model.position[0].size());
  count("points", model.operators().points);
  count("unknowns", dim * model.operators().nodes);
  if constexpr (dim == 2)
    for (std::size_t t = 0; t < model.cracks.tips.size(); ++t) {
      const fracture::CrackTip& tip = model.cracks.tips[t];
      const fracture::Ring ring = rings(input.fracture, tip).back();
      add("tip",
          fmt::format("{} at ({:.6g}, {:.6g}) m, spacing {:.3g} m, enriched within {:.3g} m, integral from "
                      "{:.3g} to {:.3g} m",
                      tip.name, input.origin.x() + tip.position.x(), input.origin.y() + tip.position.y(),
                      tip.spacing, model.cracks.enrichment_radius[t], ring.inner, ring.outer));
    }
  const std::string motion =
      missing_support(model.operators(), model.setup.problem.cloud.position, model.setup.problem.supports);
  if (motion.empty()) add("supports", "hold all rigid motions");
  if (!options.output.empty()) {
    const State<dim> state = as_state(model, at_rest(model));
    add("fields",
        write_initial_fields(input, options,
                             results::Snapshot<dim>{state, model.approximation, model.setup.problem.cloud,
                                                    model.setup.problem.contact}));
  }
  if (!motion.empty()) checked.fault = input.error("boundary", motion).what();
  return checked;
}

template class StaticRun<2>;
template class StaticRun<3>;
template Checked check_static<2>(const input::Case&, const RunOptions&);
template Checked check_static<3>(const input::Case&, const RunOptions&);

} // namespace cnem::app
