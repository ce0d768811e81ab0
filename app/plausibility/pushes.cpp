// Tools with a mass: whether what pushes them does so towards the workpiece, in time, and by how much.
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

namespace {

using Drive = contact::ToolDrive<2>;

Vec2 force_on(const Drive& drive, double t) {
  return drive.free * Vec2(drive.force[0](t), drive.force[1](t));
}

/// With that of its spring, as long as it stands, N/m (N of revolution).
Vec2 push_on(const Drive& drive, double t) {
  Vec2 push = force_on(drive, t);
  if (drive.spring)
    push += drive.spring->spring.charge(t) * drive.spring->spring.force(0.0) * drive.spring->along;
  return push;
}

/// Whether a tool comes nearer to the workpiece, or deeper into it, anywhere along its way that way.
bool nears(const StartingSurface<2>& surface, const contact::ToolShape<2>& shape, const Vec2& along) {
  const auto start = surface.gap(shape, Vec2::Zero());
  const double way = surface.size() + std::abs(start.distance);
  constexpr int samples = 64;
  for (int k = 1; k <= samples; ++k)
    if (surface.gap(shape, way * k / samples * along).distance < start.distance - 1e-3 * start.spacing)
      return true;
  return false;
}

/// Of a tool at some times of the run.
struct Pushes {
  double most = 0.0; ///< N/m (N of revolution)
  Vec2 along{0, 0};  ///< unit vector of the first one that leads nowhere
  bool towards = false;
};

Pushes pushes_on(const Drive& drive, const contact::ToolShape<2>& shape, const StartingSurface<2>& surface,
                 double end) {
  Pushes found;
  constexpr int samples = 64;
  for (int k = 0; k <= samples; ++k) {
    const Vec2 push = push_on(drive, end * k / samples);
    found.most = std::max(found.most, push.norm());
    constexpr double same = 1e-6;
    if (found.towards || !(push.norm() > 0.0) || (push.normalized() - found.along).norm() < same) continue;
    found.along = push.normalized();
    found.towards = nears(surface, shape, found.along);
  }
  return found;
}

/// Forces that come to less than they are by the end of the run.
void doubt_ramps(const input::Case& input, const contact::Tool<2>& tool, Doubts& doubts) {
  const double end = input.time.end;
  constexpr double rounding = 1e-9, little = 0.5;
  const auto late = [&](const char* key, const TimeTable& table) {
    if (table.empty() || table.times().back() <= end * (1.0 + rounding)) return;
    double most = 0.0;
    for (const double value : table.values()) most = std::max(most, std::abs(value));
    const double share = std::abs(table(end)) / most;
    if (!(share < little)) return;
    doubts.push_back(
        doubt_about(input, fmt::format("tools.{}.{}", tool.name, key),
                    fmt::format("it takes {:.3g} s to come to its full force, but the run ends at "
                                "{:.3g} s (time.end), with {:.2g}% of it",
                                table.times().back(), end, 100.0 * share)));
  };
  for (const TimeTable& component : tool.drive->force) late("force", component);
  if (tool.drive->spring) late("spring.ramp", tool.drive->spring->spring.charge);
}

/// Forces that would flatten any metal, spread over a face as large as the workpiece.
void doubt_pressure(const input::Case& input, const contact::Tool<2>& tool, double most, double size,
                    Doubts& doubts) {
  double hardest = 0.0;
  for (const plasticity::Material* material : materials_in_use(input))
    if (material->hardening) hardest = std::max(hardest, starting_flow_stress(input, *material, 1.0));
  const double face = input.analysis.space() == Space::revolution ? std::numbers::pi * size * size : size;
  constexpr double flattened = 10.0;
  if (hardest > 0.0 && most > flattened * hardest * face)
    doubts.push_back(doubt_about(
        input, fmt::format("tools.{}.{}", tool.name, tool.drive->spring ? "spring" : "force"),
        fmt::format("{:.3g} {} are {:.3g} Pa even on all of the workpiece, {:.2g} times what it flows at: "
                    "is it in the unit that is meant?",
                    most, input.analysis.space() == Space::revolution ? "N" : "N/m", most / face,
                    most / face / hardest)));
}

} // namespace

void doubt_pushes(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  if (!waits_for_tools(input, solver)) return;
  const StartingSurface<2> surface(solver);
  const double end = input.time.end;
  for (const contact::Tool<2>& tool : solver.conditions().contact.tools()) {
    if (!tool.drive) continue;
    doubt_ramps(input, tool, doubts);
    const Pushes pushes = pushes_on(*tool.drive, *tool.shape, surface, end);
    doubt_pressure(input, tool, pushes.most, surface.size(), doubts);
    const auto doubt = [&](const char* key, const std::string& text) {
      doubts.push_back(doubt_about(input, fmt::format("tools.{}.{}", tool.name, key), text));
    };
    const bool led = std::any_of(tool.motion.velocity.begin(), tool.motion.velocity.end(),
                                 [](const TimeTable& component) {
                                   return std::any_of(component.values().begin(), component.values().end(),
                                                      [](double v) { return v != 0.0; });
                                 }) ||
                     tool.drive->initial_velocity.norm() > 0.0;
    if (led || pushes.towards) continue;
    if (pushes.most > 0.0)
      doubt(tool.drive->spring ? "direction" : "force",
            fmt::format("{} is pushed along {}, away from the workpiece or past it{}", tool.name,
                        show_direction<2>(pushes.along),
                        nears(surface, *tool.shape, -pushes.along)
                            ? fmt::format(": is {} meant?", show_direction<2>(-pushes.along))
                            : ", expected the side where that lies"));
    else if (!tool.drive->spring)
      doubt("mass", fmt::format("{} has a mass and nothing that moves it: it resists by its inertia alone, "
                                "expected a force, a spring or an initial_velocity",
                                tool.name));
  }
}

} // namespace cnem::app
