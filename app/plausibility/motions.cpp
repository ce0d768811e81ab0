// Whether tools that move meet the workpiece, and when.
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace cnem::app {

namespace {

template<int dim> struct Way {
  const contact::Tool<dim>& tool;

  Vec<dim> moved(double t) const { return tool.led_displacement(t); }
  /// m/s, at the corners of its time tables up to the end: between them it is no faster.
  double fastest(double end) const {
    double most = std::max(tool.led_velocity(0.0).norm(), tool.led_velocity(end).norm());
    for (const TimeTable& component : tool.motion.velocity)
      for (const double t : component.times())
        if (t < end) most = std::max(most, tool.led_velocity(t).norm());
    return most;
  }
};

/// How far a tool is clear at most, in spacings, that touches: a corner may stand between two nodes.
constexpr double touching = 1.0;

/// The first time from `start` on at which a tool is within `reach` (m) of a workpiece that stays as it is;
/// each time it is moved on by the time in which it could be at the soonest.
template<int dim>
std::optional<double> meets(const StartingSurface<dim>& surface, const Way<dim>& way, double reach,
                            double start, double end, double& nearest) {
  const double fastest = way.fastest(end);
  constexpr double slowest = 1e-4; // share of the run by which it is moved on at least
  for (double t = start;; t = std::min(t, end)) {
    const double gap = surface.gap(*way.tool.shape, way.moved(t)).distance;
    nearest = std::min(nearest, gap);
    if (gap <= reach) return t;
    if (t >= end) return std::nullopt;
    t += std::max((gap - reach) / fastest, slowest * end);
  }
}

/// When a tool that touches has surely left: after some spacings, or half of its way where that is shorter.
/// None: it presses, or slides along.
template<int dim>
std::optional<double> leaves(const StartingSurface<dim>& surface, const Way<dim>& way,
                             const typename StartingSurface<dim>::Gap& start, double end) {
  constexpr int samples = 200;
  double longest = 0.0;
  for (int k = 1; k <= samples; ++k) longest = std::max(longest, way.moved(end * k / samples).norm());
  const double enough = std::min(4.0 * start.spacing, 0.5 * longest);
  for (int k = 1; k <= samples; ++k) {
    const double t = end * k / samples, moved = way.moved(t).norm();
    const double opened = surface.gap(*way.tool.shape, way.moved(t)).distance - start.distance;
    if (opened < -1e-3 * start.spacing) return std::nullopt; // it has pressed
    if (moved >= enough) return opened > 0.25 * moved ? std::optional(t) : std::nullopt;
  }
  return std::nullopt;
}

/// Whether a tool that touches is anywhere deeper than at the start.
template<int dim>
bool presses(const StartingSurface<dim>& surface, const Way<dim>& way,
             const typename StartingSurface<dim>::Gap& start, double end) {
  constexpr int samples = 200;
  for (int k = 1; k <= samples; ++k)
    if (surface.gap(*way.tool.shape, way.moved(end * k / samples)).distance <
        start.distance - 1e-3 * start.spacing)
      return true;
  return false;
}

template<int dim> std::string along(const Way<dim>& way, double t) {
  return "along " + show_direction<dim>(way.moved(t).normalized());
}

bool is_punch(const input::Case& input, const std::string& tool) {
  return input.report.blanking && input.tools[input.report.blanking->punch].name == tool;
}

} // namespace

template<int dim>
void doubt_motions(const input::Case& input, const ExplicitSolver<dim>& solver, Doubts& doubts) {
  if (!waits_for_tools(input, solver)) return;
  if (input.adapt.window) return; // the tool of a window stands where it cuts
  const StartingSurface<dim> surface(solver);
  const double end = input.time.end, size = surface.size();
  constexpr double beyond = 10.0; // sizes of the workpiece
  for (const contact::Tool<dim>& tool : solver.conditions().contact.tools()) {
    const Way<dim> way{tool};
    if (!(way.fastest(end) > 0.0)) continue;
    const auto start = surface.gap(*tool.shape, Vec<dim>::Zero());
    const bool led = !tool.drive || tool.drive->spring; // else it goes as forces on it say
    const bool flung = tool.drive && !(tool.motion.displacement(end).norm() > 0.0);
    const std::string key = fmt::format("tools.{}.{}", tool.name, flung ? "initial_velocity" : "velocity");
    if (const double far = way.moved(end).norm(); led && far > beyond * size) {
      doubts.push_back(doubt_about(
          input, key,
          fmt::format("{} goes {:.3g} m by time.end, {:.2g} times the size of the workpiece: are speed and "
                      "time in the units that are meant?",
                      tool.name, far, far / size)));
      continue;
    }
    double nearest = start.distance;
    if (start.distance <= touching * start.spacing) {
      const auto left = leaves(surface, way, start, end);
      if (!left && is_punch(input, tool.name) && !presses(surface, way, start, end))
        doubts.push_back(doubt_about(input, key,
                                     fmt::format("{} slides along the sheet, {}, and never goes into it: "
                                                 "expected a motion through its thickness",
                                                 tool.name, along(way, end))));
      if (!left) continue;
      const double back = start.distance + 0.05 * way.moved(*left).norm();
      if (!meets(surface, way, back, *left, end, nearest))
        doubts.push_back(doubt_about(
            input, key,
            fmt::format("{} moves away from the workpiece, {}, and does not come back by time.end", tool.name,
                        along(way, *left))));
      continue;
    }
    const auto met = meets(surface, way, touching * start.spacing, 0.0, end, nearest);
    constexpr double late = 0.1; // of the run
    const bool nearer = nearest < start.distance - 1e-6 * start.spacing;
    if (!met && !nearer)
      doubts.push_back(
          doubt_about(input, key,
                      fmt::format("{} starts {:.3g} mm clear of the workpiece and comes no nearer, {}",
                                  tool.name, 1e3 * start.distance, along(way, end))));
    else if (!met)
      doubts.push_back(doubt_about(
          input, key,
          fmt::format(
              "{} starts {:.3g} mm clear of the workpiece and does not meet it by time.end, {:.3g} s: it "
              "comes to within {:.3g} mm",
              tool.name, 1e3 * start.distance, end, 1e3 * nearest)));
    else if (*met > late * end)
      doubts.push_back(doubt_about(input, key,
                                   fmt::format("{} starts {:.3g} mm clear of the workpiece and meets it "
                                               "after {:.0f}% of the run, at {:.3g} s: "
                                               "let it begin where they touch",
                                               tool.name, 1e3 * start.distance, 100.0 * *met / end, *met)));
  }
}

template void doubt_motions(const input::Case&, const ExplicitSolver<2>&, Doubts&);
template void doubt_motions(const input::Case&, const ExplicitSolver<3>&, Doubts&);

} // namespace cnem::app
