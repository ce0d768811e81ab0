#include "app/forecast/forecast.hpp"

#include "app/divergence.hpp"
#include "app/forecast/blanking_bands.hpp"
#include "app/forecast/shear_plane.hpp"
#include "app/forecast/step_costs.hpp"
#include "app/forecast/wanted_nodes.hpp"
#include "app/plausibility/list.hpp"
#include "app/tool_tips.hpp"
#include "clouds/space/domain.hpp"
#include "core/index.hpp"
#include "input/curve_checks.hpp"
#include "input/cutting_tool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace cnem::app {

namespace {

/// Nodes that a spacing growing from `fine` to `coarse` takes per distance along a line, both of its sides.
double beside_a_line(double fine, double coarse, double growth) {
  return std::max(0.0, 2.0 / (adapt::hexagon * growth) * (1.0 / fine - 1.0 / coarse));
}

/// The same around the corner of a tool, with matter on three sides of four.
double around_a_corner(double fine, double coarse, double growth) {
  if (fine >= coarse) return 0.0;
  return 1.5 * std::numbers::pi / (adapt::hexagon * growth * growth) *
         (std::log(coarse / fine) - 1.0 + fine / coarse);
}

/// What refinement adds along a line of length `band` (m) that flows, or of its surface; `spacing`: of the
/// nodes there are, m.
double along_a_band(const input::Adaptation& rules, double band, double spacing) {
  double refined = 0.0;
  if (rules.indicator) refined = band * beside_a_line(rules.h_min, rules.h_max, rules.growth);
  if (rules.surface_spacing)
    refined = std::max(refined, 0.4 * band * beside_a_line(*rules.surface_spacing, spacing, rules.growth));
  return refined;
}

/// Slope of log flow stress over log strain at strain 1, at the rate of a chip.
double hardening_exponent(const input::Case& input) {
  const plasticity::Material& metal = *materials_in_use(input).front();
  if (!metal.hardening) return 0.0;
  const double rate = input.cutting->speed / input.cutting->feed, start = input.initial.temperature;
  return metal.hardening->hardening_modulus(1.0, rate, start) /
         metal.hardening->flow_stress(1.0, rate, start);
}

/// What adaptation adds in a cut to the nodes there are; `spacing`: of these, where they limit the step, m.
void add_nodes_of_a_cut(const input::Case& input, double spacing, Forecast& expected) {
  const input::Adaptation& rules = input.adapt;
  const input::CuttingSetup& cutting = *input.cutting;
  if (rules.tool_spacing) expected.nodes_first += around_a_corner(*rules.tool_spacing, spacing, rules.growth);
  // Shear plane and contact of the chip, which go with its thickness.
  const double ratio = foretold_chip_ratio(cutting.rake, cutting.friction, hardening_exponent(input));
  const double band = 4.8 * ratio * cutting.feed;
  expected.nodes_last = expected.nodes_first += along_a_band(rules, band, spacing);
  if (rules.rest_factor > 0.0) return; // what rests takes as many as the cloud had there
  const double way = std::min(cutting.length, input.time.end * cutting.speed);
  // Cells that were made fine stay within 0.4 of what is wanted there: along the machined surface, and in
  // the chip, which a quarter more than the finest spacing was measured in.
  expected.nodes_last += 0.5 * way * beside_a_line(0.4 * spacing, spacing, rules.growth);
  if (rules.indicator)
    expected.nodes_last += way * cutting.feed / (adapt::hexagon * std::pow(1.25 * rules.h_min, 2));
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
    fastest = std::max(fastest, material.fastest_wave());
  return safety * 0.73 * spacing / fastest;
}

/// Of a node and step, s: of one thread on an idle core, from the runs of docs/cutting.md;
/// docs/performance.md has the parts.
template<int dim> double cost_of_steps(const input::Case& input, const ExplicitSolver<dim>& solver) {
  if constexpr (dim == 2)
    return (input.contact.active ? 115.0 : 90.0) * 1e-9 + added_cost_of_steps(input, solver);
  return (input.contact.active ? 500.0 : input.tools.empty() ? 130.0 : 360.0) * 1e-9;
}

/// The same of passes, over the steps there would be with masses as they are: they come by the strain, the
/// rarer the more of it a reference bears, which longer steps do not change.
template<int dim> double cost_of_passes(const input::Case& input, const ExplicitSolver<dim>& solver) {
  if (!input.adapt.resample || (dim == 3 && input.tools.empty())) return 0.0;
  const double strain = input.method.rereference_strain;
  const double cost = (strain > 0.0 ? (dim == 2 ? 6.7 : 29.0) / strain : dim == 2 ? 30.0 : 130.0) * 1e-9;
  if constexpr (dim == 2)
    if (leaves_debris(input, solver)) return step_costs::passes_of_debris * cost;
  return cost;
}

/// By how much steps get shorter in space while tools go on, whose cells passes there keep less even than in
/// the plane: by their way over the spacing of the cells that limit the first step, from the runs of
/// docs/cutting.md.
double squeezed_by_tools(const input::Case& input, const ExplicitSolver<3>& solver, double spacing) {
  if (!input.adapt.resample || input.time.fixed) return 1.0;
  constexpr double each = 0.1, most = 10.0;
  double way = 0.0;
  for (const contact::Tool<3>& tool : solver.conditions().contact.tools())
    way = std::max(way, tool.led_displacement(input.time.end).norm());
  return 1.0 + each * std::min(way / spacing, most);
}

/// A part of the run in which cells of one spacing limit the step.
struct Stretch {
  double duration = 0.0, spacing = 0.0; ///< s, m
  double nodes = 0.0;                   ///< in the mean
};

/// Steps of cells of any spacing, from those at the start of a run.
class Steps {
public:
  template<int dim>
  Steps(const input::Case& input, const ExplicitSolver<dim>& solver, const StepControl& control,
        double spacing)
      : time_(&input.time), start_(control.stable()), own_(start_), spacing_(spacing),
        wanted_(std::min(start_, solver.wanted_step())), limit_(control.limit()) {
    // Of revolution a cell at the axis may limit the step that no fine one is near.
    if constexpr (dim == 2)
      if (input.analysis.space() == Space::revolution)
        own_ = std::max(own_, usual_step(solver.model(), spacing, input.time.safety));
  }

  /// With masses as they are, s.
  double light(double spacing) const { return own_ * spacing / spacing_; }
  /// With mass scaling and `time.step`, s.
  double of(double spacing) const {
    if (time_->fixed || spacing == spacing_) return limit_;
    return std::min(std::max(light(spacing), wanted_), time_->max_step.value_or(start_));
  }

private:
  const input::TimeControl* time_;
  double start_, own_, spacing_, wanted_, limit_;
};

/// The course of a run whose cells are made finer where tools are and where metal is cut through.
std::vector<Stretch> course_of_blanking(const input::Case& input, const ExplicitSolver<2>& solver,
                                        const adapt::Structure& structure, const Steps& steps,
                                        Forecast& expected) {
  const input::Adaptation& rules = input.adapt;
  const WantedNodes wanted(input, solver.conditions().cloud, structure);
  const double start = expected.finest, count = expected.nodes_first;
  constexpr double kept_at_tools = 1.6; // cells at rest there are so much wider than wanted
  double spacing = start;
  if (rules.tool_spacing) spacing = std::min(spacing, kept_at_tools * *rules.tool_spacing);
  expected.finest = spacing;
  expected.nodes_last = expected.nodes_first += wanted.added({});

  const std::vector<evaluate::Clearance> cuts = foretold_cuts(input, solver);
  const double begins = cuts.empty() ? 0.0 : flow_begins(input, solver, cuts.front());
  if (begins >= input.time.end) return {{input.time.end, spacing, expected.nodes_first}};
  double fine = spacing; // where it flows
  if (cuts.empty()) {
    expected.nodes_last += along_a_band(rules, smaller_side(input), start);
    if (rules.indicator) fine = std::min(fine, rules.h_min);
  } else if (rules.indicator) {
    const RefinedBands bands = refined_bands(input, cuts, wanted, structure, expected.nodes_first, count);
    expected.nodes_last = bands.nodes;
    expected.indicated = bands.finest;
    expected.finest = std::min(expected.finest, bands.finest);
    constexpr double squeezed = 0.87; // the step of what flows over that of cells at rest
    if (expected.finest < fine) fine = squeezed * expected.finest;
  } else {
    expected.nodes_last += along_a_band(rules, smaller_side(input), start);
  }
  if (rules.surface_spacing) fine = std::min(fine, *rules.surface_spacing);
  if (cuts.empty()) expected.finest = fine;

  // Marking halves the spacing at each pass.
  std::vector<Stretch> course{{begins, spacing, expected.nodes_first}};
  const double mean = 0.5 * (expected.nodes_first + expected.nodes_last);
  double left = input.time.end - begins;
  for (double next = spacing; next > fine && left > 0.0; next *= 0.5) {
    const double duration = std::min(left, input.method.rereference_every * steps.of(next));
    course.push_back({duration, next, mean});
    left -= duration;
  }
  course.push_back({left, fine, expected.nodes_last});
  return course;
}

/// What adapt.tool_spacing adds in space: Σ V (1/h³ − 1/h0³) over 4³ parts of each cell, taken for a cube.
double nodes_at_ridges(const input::Case& input, const ExplicitSolver<3>& solver) {
  const contact::RigidContact<3>& contact = solver.conditions().contact;
  const clouds::SpaceSpacing spacing{input.cloud.spacing, input.cloud.space_refinements};
  const Field volume = solver.approximation().mechanics.node_volume();
  const double fine = *input.adapt.tool_spacing, growth = input.adapt.growth;
  constexpr int parts = 4;
  double nodes = 0.0;
  for (const NodeIndex i : solver.conditions().cloud.position.indices()) {
    const Vec3& x = solver.conditions().cloud.position[i];
    const double h0 = spacing.at(x), reach = (h0 - fine) / growth, edge = std::cbrt(volume[index_of(i)]);
    if (reach <= 0.0 || distance_from_ridges(contact, x, reach + edge) >= reach + edge) continue;
    for (int part = 0; part < parts * parts * parts; ++part) {
      const Vec3 place(part % parts, part / parts % parts, part / (parts * parts));
      const Vec3 at = x + edge * ((place.array() + 0.5) / parts - 0.5).matrix();
      const double h = fine + growth * distance_from_ridges(contact, at, reach);
      nodes += volume[index_of(i)] / (parts * parts * parts) * (std::pow(h, -3.0) - std::pow(h0, -3.0));
    }
  }
  return nodes;
}

} // namespace

template<int dim>
Forecast forecast(const input::Case& input, const ExplicitSolver<dim>& solver, const StepControl& control) {
  const auto count = static_cast<double>(solver.state().node.size());
  Forecast expected;
  expected.nodes_first = expected.nodes_last = count;
  std::vector<Stretch> course;
  double spacing = 0.0;  // m, of the cells that limit the first step
  double squeezed = 1.0; // steps that are taken over those of cells as they are
  if constexpr (dim == 2) {
    const Cloud<2>& cloud = solver.conditions().cloud;
    const adapt::Structure structure = adapt::build_structure(cloud, input.analysis.space());
    const Field spacings = adapt::spacing_of(cloud, structure);
    spacing = expected.finest = control.point() ? spacings[node_of(solver, *control.point())]
                                                : *std::min_element(spacings.begin(), spacings.end());
    if (input.adapt.resample && input.cutting) {
      add_nodes_of_a_cut(input, spacing, expected);
      expected.nodes_last += gained_by_window(input) * count;
      expected.finest = std::min(spacing, adapted_spacing(input));
    } else if (input.adapt.resample) {
      course = course_of_blanking(input, solver, structure, Steps(input, solver, control, spacing), expected);
    }
  }
  if constexpr (dim == 3) {
    const clouds::SpaceSpacing wanted{input.cloud.spacing, input.cloud.space_refinements};
    spacing = expected.finest =
        control.point() ? wanted.at(solver.conditions().cloud.position[node_of(solver, *control.point())])
                        : input.cloud.spacing;
    squeezed = squeezed_by_tools(input, solver, spacing);
    if (input.adapt.tool_spacing) {
      expected.nodes_last = expected.nodes_first += nodes_at_ridges(input, solver);
      expected.finest = std::min(spacing, *input.adapt.tool_spacing);
    }
  }
  if (course.empty())
    course = {{input.time.end, expected.finest, 0.5 * (expected.nodes_first + expected.nodes_last)}};
  const Steps steps(input, solver, control, spacing);
  const double cost = cost_of_steps(input, solver), passes = cost_of_passes(input, solver);
  double node_steps = 0.0;
  for (const Stretch& stretch : course) {
    const double step = steps.of(stretch.spacing), taken = squeezed * stretch.duration / step;
    expected.steps += taken;
    node_steps += taken * stretch.nodes;
    expected.seconds += taken * stretch.nodes * (cost + step / steps.light(stretch.spacing) * passes);
  }
  expected.nodes_mean = node_steps / expected.steps;
  expected.steps = std::ceil(expected.steps);
  if (input.time.max_steps && static_cast<double>(*input.time.max_steps) < expected.steps) {
    expected.seconds *= static_cast<double>(*input.time.max_steps) / expected.steps;
    expected.steps = static_cast<double>(*input.time.max_steps);
  }
  return expected;
}

template Forecast forecast<2>(const input::Case&, const ExplicitSolver<2>&, const StepControl&);
template Forecast forecast<3>(const input::Case&, const ExplicitSolver<3>&, const StepControl&);

} // namespace cnem::app
