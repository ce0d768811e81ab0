#include "app/forecast.hpp"

#include "adapt/structure.hpp"
#include "app/divergence.hpp"
#include "app/plausibility/plausibility.hpp"
#include "input/curve_checks.hpp"
#include "input/cutting_tool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::app {

namespace {

const double hexagon = 0.5 * std::sqrt(3.0); ///< area of a cell over the square of the spacing

/// Nodes that a spacing growing from `fine` to `coarse` takes per distance along a line, both of its sides.
double beside_a_line(double fine, double coarse, double growth) {
  return std::max(0.0, 2.0 / (hexagon * growth) * (1.0 / fine - 1.0 / coarse));
}

/// The same around the corner of a tool, with matter on three sides of four.
double around_a_corner(double fine, double coarse, double growth) {
  if (fine >= coarse) return 0.0;
  return 1.5 * std::numbers::pi / (hexagon * growth * growth) *
         (std::log(coarse / fine) - 1.0 + fine / coarse);
}

/// The smaller side of the workpiece, m.
double least_side(const Curve& outline) {
  const auto [low, high] = input::bounds(outline);
  return (high - low).minCoeff();
}

/// What adaptation adds to the nodes there are; `spacing`: of these, where they limit the step, m; `cuts`:
/// how many sides of a punch cut.
void add_nodes(const input::Case& input, double spacing, std::size_t cuts, Forecast& expected) {
  const input::Adaptation& rules = input.adapt;
  const auto& cutting = input.cutting;
  if (rules.tool_spacing) {
    const double corners = cutting ? 1.0 : static_cast<double>(input.tools.size());
    expected.nodes_first += corners * around_a_corner(*rules.tool_spacing, spacing, rules.growth);
  }
  // A band: shear plane and contact of the chip, else through the workpiece; what flows of its surface. Bands
  // of blanks move and leave two faces, for which cells stay fine: 1.9 times as many in cases/blanking.
  const double spread = cuts > 0 ? 1.9 * static_cast<double>(cuts) : 1.0;
  const double band = cutting ? 4.5 * cutting->feed : spread * least_side(input.domain.outer);
  double refined = 0.0;
  if (rules.indicator) refined = band * beside_a_line(rules.h_min, rules.h_max, rules.growth);
  if (rules.surface_spacing)
    refined = std::max(refined, 0.4 * band * beside_a_line(*rules.surface_spacing, spacing, rules.growth));
  expected.nodes_last = expected.nodes_first += refined;
  if (!cutting || rules.rest_factor > 0.0) return; // what rests takes as many as the cloud had there
  const double way = std::min(cutting->length, input.time.end * cutting->speed);
  // Cells that were made fine stay within 0.4 of what is wanted there: along the machined surface, and in
  // the chip, which a quarter more than the finest spacing was measured in.
  expected.nodes_last += 0.5 * way * beside_a_line(0.4 * spacing, spacing, rules.growth);
  if (rules.indicator)
    expected.nodes_last += way * cutting->feed / (hexagon * std::pow(1.25 * rules.h_min, 2));
}

/// Share of the matter there is at the start that a window which moves has gained when it is full: what the
/// tool has passed, and half of a strip.
double gained_by_window(const input::Case& input) {
  if (!input.adapt.window) return 0.0;
  const input::MovingWindow& window = *input.adapt.window;
  const input::CuttingTool cut = input::cutting_tool(input, window.tool);
  const auto [low, high] = input::bounds(input.domain.outer);
  const double there = std::abs((high - low).dot(cut.along));
  return std::max(0.0, window.ahead + window.behind + window.strip - there) / there;
}

/// The stable step of cells in the plane, s: nearly three quarters of the time in which a wave crosses one.
double usual_step(const Model<2>& model, double spacing, double safety) {
  double fastest = 0.0;
  for (const plasticity::Material& material : model.materials)
    fastest = std::max(fastest, material.elasticity.dilatational_speed(material.density));
  return safety * 0.73 * spacing / fastest;
}

/// Of a node and step, s: of one thread on an idle core, from the runs of docs/cutting.md;
/// docs/performance.md has the parts.
double cost_of_steps(const input::Case& input) { return (input.contact.active ? 115.0 : 90.0) * 1e-9; }

/// The same of passes, over the steps there would be with masses as they are: they come by the strain, the
/// rarer the more of it a reference bears, which longer steps do not change.
double cost_of_passes(const input::Case& input) {
  if (!input.adapt.resample) return 0.0;
  const double strain = input.method.rereference_strain;
  return (strain > 0.0 ? 6.7 / strain : 30.0) * 1e-9;
}

} // namespace

template<int dim>
Forecast forecast(const input::Case& input, const ExplicitSolver<dim>& solver, const StepControl& control) {
  const auto count = static_cast<double>(solver.state().node.size());
  Forecast expected{.nodes_first = count, .nodes_last = count};
  double step = control.limit(), light = step; // light: with masses as they are
  if constexpr (dim == 2) {
    const Cloud<2>& cloud = solver.conditions().cloud;
    const Field spacing = adapt::spacing_of(cloud, adapt::build_structure(cloud, input.analysis.space()));
    expected.finest = control.point() ? spacing[node_of(solver, *control.point())]
                                      : *std::min_element(spacing.begin(), spacing.end());
    if (input.adapt.resample) {
      add_nodes(input, expected.finest, clearances(input, solver).size(), expected);
      expected.nodes_last += gained_by_window(input) * count;
      const double coarse = expected.finest;
      if (input.adapt.tool_spacing && !input.tools.empty())
        expected.finest = std::min(expected.finest, *input.adapt.tool_spacing);
      if (input.adapt.surface_spacing)
        expected.finest = std::min(expected.finest, *input.adapt.surface_spacing);
      if (input.adapt.indicator) expected.finest = std::min(expected.finest, input.adapt.h_min);
      if (!input.time.fixed) {
        // Of revolution a cell at the axis may limit the step that no fine one is near.
        if (input.analysis.space() == Space::revolution)
          light = std::max(light, usual_step(solver.model(), coarse, input.time.safety));
        light *= expected.finest / coarse;
        step = std::max(light, std::min(step, solver.wanted_step()));
      }
    }
  }
  expected.steps = std::ceil(input.time.end / step);
  if (input.time.max_steps)
    expected.steps = std::min(expected.steps, static_cast<double>(*input.time.max_steps));
  expected.seconds =
      expected.steps * expected.nodes_mean() * (cost_of_steps(input) + step / light * cost_of_passes(input));
  return expected;
}

template Forecast forecast<2>(const input::Case&, const ExplicitSolver<2>&, const StepControl&);
template Forecast forecast<3>(const input::Case&, const ExplicitSolver<3>&, const StepControl&);

} // namespace cnem::app
