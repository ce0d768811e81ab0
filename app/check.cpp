#include "adapt/indicated_fields.hpp"
#include "app/divergence.hpp"
#include "app/forecast/forecast.hpp"
#include "app/machining/machining_session.hpp"
#include "app/places.hpp"
#include "app/plausibility/plausibility.hpp"
#include "app/run.hpp"
#include "app/simulation.hpp"
#include "app/statics/statics.hpp"
#include "app/watches/fixed_step.hpp"
#include "app/watches/tool_speed.hpp"
#include "core/index.hpp"
#include "core/machine/threads.hpp"
#include "input/schema/document.hpp"
#include "input/schema/expression.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/recorder.hpp"
#include "results/si_format.hpp"
#include "results/status.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

namespace {

/// Of an indicator that comes to cells of `finest`, m.
void doubt_indicator(const input::Case& input, double finest, std::vector<std::string>& warnings) {
  constexpr double much = 1.5;
  if (finest < much * input.adapt.h_min) return;
  const bool absolute = input.adapt.indicator == adapt::indicated_field("temperature");
  warnings.push_back(
      input
          .error("adapt.indicator.tolerance",
                 fmt::format("{:.3g} of the norm of {} makes cells of {:.3g} mm where metal is cut, not of "
                             "h_min = {:.3g} mm: {}",
                             input.adapt.tolerance, input.adapt.indicator->name, 1e3 * finest,
                             1e3 * input.adapt.h_min,
                             absolute ? "it counts from 0 K, of which a cut adds little: take plastic_strain"
                                      : "lower it, or raise h_min"))
          .what());
}

template<int dim> Checked check_explicit(const input::Case& input, const RunOptions& options) {
  Checked checked;
  ExplicitSolver<dim> solver = make_solver<dim>(input, checked.warnings);
  refuse_snap_back(input, solver);
  StepControl control(input.time);
  control.refresh(solver);
  for (std::string& warning : supersonic_tools(input, solver)) checked.warnings.push_back(std::move(warning));
  for (std::string& warning : unstable_fixed_step(input, solver))
    checked.warnings.push_back(std::move(warning));
  for (std::string& doubt : doubts(input, solver)) checked.warnings.push_back(std::move(doubt));
  if (!input.adapt.tool_spacing) check_tool_steps(input, solver, control.limit() / solver.sub_steps());
  const Forecast expected = forecast(input, solver, control);
  if (expected.indicated) doubt_indicator(input, *expected.indicated, checked.warnings);
  if (constexpr double day = 86400.0; expected.seconds > day)
    checked.warnings.push_back(
        input
            .error(
                "time.end",
                fmt::format("about {:.2g} steps, {} of one core: shorten the run, let tools move faster as "
                            "long as rates and inertia do not matter, or make steps longer "
                            "(time.mass_scaling)",
                            expected.steps, results::duration_format(expected.seconds)))
            .what());
  const State<dim>& state = solver.state();
  const std::string place =
      control.point()
          ? input.placed(" at " + show_place<dim>(state.node.position, node_of(solver, *control.point())))
          : "";
  const auto add = [&](const char* label, std::string text) {
    checked.facts.emplace_back(label, std::move(text));
  };
  const bool whole = dim == 3 || solver.approximation().mechanics.of_revolution();
  const double measure = results::enclosed_measure(results::snapshot(solver));
  add("case", input.title.empty() ? input.name : input.title);
  add("nodes", fmt::format("{}", state.node.size()));
  add("points", fmt::format("{}", state.point.size()));
  add(whole ? "volume" : "area", fmt::format("{:.9g} {}", measure, whole ? "m³" : "m²"));
  add("first step",
      fmt::format("{:.4g} s, limited by {}{}{}", control.limit(), control.limited_by(), place,
                  solver.sub_steps() > 1 ? fmt::format(", in {} finest steps", solver.sub_steps()) : ""));
  const std::string most = fmt::format("{:.0f}", expected.nodes_last),
                    first = fmt::format("{:.0f}", expected.nodes_first);
  add("steps",
      fmt::format("about {:.12g} to t = {:.4g} s{}", expected.steps, input.time.end,
                  input.adapt.resample ? fmt::format(", with cells of {:.3g} m and {} nodes", expected.finest,
                                                     first == most ? most : first + " to " + most)
                                       : ""));
  checked.numbers = {{"nodes", static_cast<double>(state.node.size())},
                     {"points", static_cast<double>(state.point.size())},
                     {whole ? "volume" : "area", measure},
                     {"first_step", control.limit()},
                     {"steps", expected.steps},
                     {"nodes_at_end", expected.nodes_last},
                     {"seconds", expected.seconds}};
  add("time",
      fmt::format("about {} of one core, without pictures", results::duration_format(expected.seconds)));
  add("memory", fmt::format("{:.0f} MB", static_cast<double>(results::peak_rss_bytes()) / 1e6));
  const auto overlaps = solver.conditions().contact.overlaps(state.node.position, 0.0);
  checked.numbers.emplace_back("overlaps", static_cast<double>(overlaps.size()));
  if (overlaps.empty())
    add("tools", fmt::format("{} without overlap", solver.conditions().contact.tools().size()));
  else
    add("tools", fmt::format("{} places where a tool overlaps the workpiece, the deepest:", overlaps.size()));
  for (std::size_t k = 0; k < std::min<std::size_t>(overlaps.size(), 3); ++k)
    add("", input.placed(fmt::format("{} by {:.3g} m at {}",
                                     solver.conditions().contact.tools()[overlaps[k].tool].name,
                                     overlaps[k].depth, show_place<dim>(overlaps[k].position))));
  if constexpr (dim == 2)
    for (auto& [label, text] : tool_measures(input, solver))
      checked.facts.emplace_back(std::move(label), std::move(text));
  if (!options.output.empty()) add("fields", write_initial_fields(input, options, results::snapshot(solver)));
  return checked;
}

/// With what it was calculated from, where that says more.
std::string variable_text(const input::Variable& variable) {
  const bool angle = variable.unit == "rad";
  const std::string value = angle ? results::number_format(variable.value * 180.0 / std::numbers::pi) + " deg"
                                  : results::si_format(variable.value, variable.unit);
  const bool calculated = !variable.expression.empty() && !input::is_plain(variable.expression);
  return value + (calculated ? fmt::format(" ({})", input::shortened(variable.expression)) : "");
}

} // namespace

template<int dim>
std::string write_initial_fields(const input::Case& input, const RunOptions& options,
                                 const results::Snapshot<dim>& shot) {
  const std::filesystem::path folder = options.output / "initial";
  results::prepare_output_folder(folder, true);
  results::FileQueue files;
  results::FieldRecorder(folder, input).record(files, shot);
  files.wait();
  return (folder / results::files::fields).string();
}

template std::string write_initial_fields(const input::Case&, const RunOptions&, const results::Snapshot<2>&);
template std::string write_initial_fields(const input::Case&, const RunOptions&, const results::Snapshot<3>&);

std::vector<std::pair<std::string, std::string>> variable_texts(const input::Case& input) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const input::Variable& variable : input.variables)
    list.emplace_back(variable.name, variable_text(variable));
  return list;
}

Checked check(const input::Case& input, const RunOptions& options) {
  const ThreadCount threads(options.threads);
  use_threads(options.threads);
  const bool space = input.analysis.dimensions() == 3;
  if (input.analysis.of_milling()) return check_machining(input);
  if (input.analysis.type == input::Analysis::Type::statics)
    return space ? check_static<3>(input, options) : check_static<2>(input, options);
  return space ? check_explicit<3>(input, options) : check_explicit<2>(input, options);
}

} // namespace cnem::app
