#include "app/explain.hpp"

#include "input/space_domain.hpp"

#include "app/forecast/forecast.hpp"
#include "app/machining/machining_session.hpp"
#include "app/simulation.hpp"
#include "clouds/generate.hpp"
#include "input/curve_checks.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

namespace {

using results::number_format;
using results::si_format;

std::string line(const char* name, const std::string& text) { return fmt::format("{:<11} {}\n", name, text); }

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

std::string size_of(const input::Domain& domain) {
  if (domain.in_space()) {
    const auto [low, high] = input::space_bounds(domain);
    return fmt::format("{} x {} x {}", si_format(high.x() - low.x(), "m"), si_format(high.y() - low.y(), "m"),
                       si_format(high.z() - low.z(), "m"));
  }
  const auto [low, high] = input::bounds(domain.outer);
  return fmt::format("{} x {}", si_format(high.x() - low.x(), "m"), si_format(high.y() - low.y(), "m"));
}

/// How fast it moves at the end of the run, in words.
std::string motion_of(const input::Tool& tool, double end) {
  if (tool.drive && !tool.drive->spring) return "driven by forces and inertia";
  double speed = 0.0;
  for (const auto& component : tool.velocity)
    if (component) speed = std::hypot(speed, (*component)(end));
  const std::string moves = speed > 0.0 ? fmt::format("moves at {}", si_format(speed, "m/s")) : "at rest";
  return tool.drive ? "a body on a spring whose far end " + (speed > 0.0 ? moves : "is " + moves) : moves;
}

std::string subject(const input::Case& input) {
  const char* kind = input.analysis.dimensions() == 3              ? "in space"
                     : input.analysis.space() == Space::revolution ? "of revolution"
                                                                   : "in the plane";
  std::string text =
      line("case", input.title.empty() ? input.name : input.title) +
      line("workpiece", fmt::format("{} {}, {}{}", size_of(input.domain), kind, input.domain.material,
                                    input.analysis.thermal ? ", with heat" : ", without heat"));
  for (const input::Tool& tool : input.tools)
    text += line("tool", fmt::format("{} {}", tool.name, motion_of(tool, input.time.end)));
  return text;
}

/// What decides about a cut.
std::string cut_text(const input::Case& input, const Forecast& expected) {
  const input::CuttingSetup& cut = *input.cutting;
  const plasticity::Material& metal = input.material(input.domain.material);
  const double f = cut.feed, r = cut.edge_radius;
  std::string text =
      line("cut", fmt::format("{} of chip thickness, {} wide, over {}; rake {} deg, clearance {} deg",
                              si_format(f, "m"), si_format(cut.width, "m"), si_format(cut.length, "m"),
                              number_format(degrees(cut.rake)), number_format(degrees(cut.clearance))));
  if (cut.chamfer)
    text += line("land", fmt::format("{} at {} deg to the rake face", si_format(cut.chamfer->width, "m"),
                                     number_format(degrees(cut.chamfer->angle))));
  text += line("edge", fmt::format("radius {}, r/f = {}: {}", si_format(r, "m"), number_format(r / f, 2),
                                   r <= 0.1 * f   ? "sharp, forces are those of the chip"
                                   : r <= 0.5 * f ? "honed, ploughing shows in the forces"
                                                  : "blunt, the rake that cuts is that of the arc"));
  if (const auto& window = input.adapt.window)
    text +=
        line("window", fmt::format("goes with the tool: {} ahead of it, {} behind{}",
                                   si_format(window->ahead, "m"), si_format(window->behind, "m"),
                                   window->chip ? ", " + si_format(*window->chip, "m") + " of chip" : ""));
  const double first = cut.rake - (cut.chamfer ? cut.chamfer->angle : 0.0);
  const double arc = r * (0.5 * std::numbers::pi + cut.clearance + first);
  const double flowing = input.adapt.indicator ? input.adapt.h_min : input.cloud.at({0.0, 0.5 * f});
  text += line("cells", fmt::format("{:.0f} over the feed where it flows, {:.0f} along the arc of the edge",
                                    f / flowing, arc / input.adapt.tool_spacing.value_or(flowing)));
  if (metal.conductivity > 0.0 && input.analysis.thermal) {
    const double peclet = cut.speed * f * metal.density * metal.specific_heat / metal.conductivity;
    text += line("heat", fmt::format("Péclet number V f/(k/(ρ c)) = {}: {}", number_format(peclet, 3),
                                     peclet > 10.0  ? "it goes with the chip, hardly any into the workpiece"
                                     : peclet > 0.5 ? "part of it flows into the workpiece"
                                                    : "it spreads faster than the tool moves"));
  }
  if (metal.hardening) {
    const double stress = metal.hardening->flow_stress(1.0, cut.speed / f, input.initial.temperature);
    const double scaling = input.time.mass_scaling.value_or(MassScaling{}).factor;
    const double share = 0.5 * scaling * metal.density * cut.speed * cut.speed / stress;
    text += line("inertia",
                 fmt::format("½ρV²/σ = {}: {}", number_format(share, 2),
                             share < 0.01 ? "forces are those of a slow cut" : "it acts on the forces"));
    constexpr double little = 0.005, heavy = 400.0, tedious = 900.0;
    const bool scaled = input.time.mass_scaling && input.time.mass_scaling->factor > 1.0;
    if (!scaled && heavy * share < little && expected.seconds > tedious)
      text += line("note", fmt::format("inertia permits --set time.mass_scaling.factor={:g}, in place of "
                                       "time.mass_scaling.cell: {:g} times the step that cells have without",
                                       heavy, std::sqrt(heavy)));
  }
  constexpr double steady = 10.0, long_run = 3600.0;
  if (cut.length > 2.0 * steady * f && expected.seconds > long_run)
    text += line("note",
                 fmt::format("forces of a steady chip need some {} of cut: --set cutting.length=\"{} mm\"",
                             si_format(steady * f, "m"), number_format(steady * f * 1e3)));
  if (input.time.end * cut.speed > 1.05 * cut.length && !cut.exit)
    text += line("note", fmt::format("time.end lets the tool go {}, beyond the length of cut",
                                     si_format(input.time.end * cut.speed, "m")));
  return text;
}

template<int dim> std::string explicit_text(const input::Case& input) {
  std::vector<std::string> warnings;
  ExplicitSolver<dim> solver = make_solver<dim>(input, warnings);
  StepControl control(input.time);
  control.refresh(solver);
  const Forecast expected = forecast(input, solver, control);
  std::string text = input.cutting ? cut_text(input, expected) : "";
  text += line("nodes", expected.nodes_last > 1.05 * expected.nodes_first
                            ? fmt::format("about {:.0f} at first, {:.0f} at the end", expected.nodes_first,
                                          expected.nodes_last)
                            : fmt::format("about {:.0f}", expected.nodes_first));
  text +=
      line("steps", fmt::format("about {:.0f} to t = {}", expected.steps, si_format(input.time.end, "s")));
  text += line("time", fmt::format("about {} of one core, without pictures",
                                   results::duration_format(expected.seconds)));
  for (const std::string& warning : warnings) text += line("warning", warning);
  return text;
}

} // namespace

std::string explanation(const input::Case& input) {
  if (input.analysis.of_milling()) {
    std::string text;
    for (const auto& [label, fact] : check_machining(input).facts) text += line(label.c_str(), fact);
    return text;
  }
  std::string text = subject(input);
  if (input.analysis.type == input::Analysis::Type::statics)
    return text + line("solution", "one, of equilibrium at small strain");
  return text + (input.analysis.dimensions() == 3 ? explicit_text<3>(input) : explicit_text<2>(input));
}

} // namespace cnem::app
