#include "app/divergence.hpp"
#include "app/forecast.hpp"
#include "app/places.hpp"
#include "app/plausibility/plausibility.hpp"
#include "app/run.hpp"
#include "app/simulation.hpp"
#include "app/statics/statics.hpp"
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

template<int dim> void check_explicit(const input::Case& input, const RunOptions& options) {
  std::vector<std::string> warnings;
  ExplicitSolver<dim> solver = make_solver<dim>(input, warnings);
  StepControl control(input.time);
  control.refresh(solver);
  for (std::string& warning : supersonic_tools(input, solver)) warnings.push_back(std::move(warning));
  for (std::string& doubt : doubts(input, solver)) warnings.push_back(std::move(doubt));
  if (!input.adapt.tool_spacing) check_tool_steps(input, solver, control.limit() / solver.sub_steps());
  const Forecast expected = forecast(input, solver, control);
  if (constexpr double day = 86400.0; expected.seconds > day)
    warnings.push_back(
        input
            .error(
                "time.end",
                fmt::format("about {:.2g} steps, {} of one core: shorten the run, let tools move faster as "
                            "long as rates and inertia do not matter, or make steps longer "
                            "(time.mass_scaling)",
                            expected.steps, results::duration_format(expected.seconds)))
            .what());
  const State<dim>& state = solver.state();
  const std::size_t node = node_of(solver, control.point());
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  fmt::print("case        {}\n", input.title.empty() ? input.name : input.title);
  fmt::print("nodes       {}\n", state.node.size());
  fmt::print("points      {}\n", state.point.size());
  const bool whole = dim == 3 || solver.approximation().mechanics.of_revolution();
  fmt::print("{:<11} {:.9g} {}\n", whole ? "volume" : "area",
             results::enclosed_measure(results::snapshot(solver)), whole ? "m³" : "m²");
  fmt::print("first step  {:.4g} s, limited by {}", control.limit(), control.limited_by());
  if (!input.time.fixed) fmt::print("{}", input.placed(" at " + show_place<dim>(state.node.position, node)));
  if (solver.sub_steps() > 1) fmt::print(", in {} finest steps", solver.sub_steps());
  fmt::print("\nsteps       about {:.12g} to t = {:.4g} s", expected.steps, input.time.end);
  if (input.adapt.resample)
    fmt::print(", with cells of {:.3g} m and {:.0f} to {:.0f} nodes", expected.finest, expected.nodes_first,
               expected.nodes_last);
  fmt::print("\n");
  fmt::print("time        about {} of one core, without pictures\n",
             results::duration_format(expected.seconds));
  fmt::print("memory      {:.0f} MB\n", static_cast<double>(results::peak_rss_bytes()) / 1e6);
  const auto overlaps = solver.conditions().contact.overlaps(state.node.position, 0.0);
  if (overlaps.empty()) {
    fmt::print("tools       {} without overlap\n", solver.conditions().contact.tools().size());
  } else {
    fmt::print("tools       {} places where a tool overlaps the workpiece, the deepest:\n", overlaps.size());
    for (std::size_t k = 0; k < std::min<std::size_t>(overlaps.size(), 3); ++k)
      fmt::print("            {}\n",
                 input.placed(fmt::format("{} by {:.3g} m at {}",
                                          solver.conditions().contact.tools()[overlaps[k].tool].name,
                                          overlaps[k].depth, show_place<dim>(overlaps[k].position))));
  }
  if constexpr (dim == 2)
    for (const auto& [label, text] : tool_measures(input, solver)) fmt::print("{:<11} {}\n", label, text);
  const std::filesystem::path folder = options.output / "initial";
  results::prepare_output_folder(folder, true);
  results::FileQueue files;
  results::FieldRecorder(folder, input).record(files, results::snapshot(solver));
  files.wait();
  fmt::print("fields      {}\n", (folder / results::files::fields).string());
}

/// With what it was calculated from, where that says more.
void print_variable(const input::Variable& variable) {
  const bool angle = variable.unit == "rad";
  const std::string value = angle ? results::number_format(variable.value * 180.0 / std::numbers::pi) + " deg"
                                  : results::si_format(variable.value, variable.unit);
  const bool calculated = !variable.expression.empty() && !input::is_plain(variable.expression);
  fmt::print("variable    {} = {}{}\n", variable.name, value,
             calculated ? fmt::format(" ({})", input::shortened(variable.expression)) : "");
}

} // namespace

void check(const input::Case& input, const RunOptions& options) {
  use_threads(options.threads);
  for (const input::Variable& variable : input.variables) print_variable(variable);
  if (input.analysis.type == input::Analysis::Type::statics) return check_static(input, options);
  input.analysis.dimensions() == 3 ? check_explicit<3>(input, options) : check_explicit<2>(input, options);
}

} // namespace cnem::app
