#include "app/tool_speed.hpp"

#include "app/places.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::app {
namespace {

/// Velocities of a tool that tell how fast it is, m/s: at the corners of its time tables up to the end, else
/// at the start.
template<int dim>
std::vector<Vec<dim>> velocities_of(const input::Case& input, const contact::Tool<dim>& tool) {
  if (tool.drive) return {tool.drive->free * tool.drive->initial_velocity};
  std::vector<double> times{0.0, input.time.end};
  for (const TimeTable& component : tool.motion.velocity)
    for (const double t : component.times())
      if (t > 0.0 && t < input.time.end) times.push_back(t);
  std::vector<Vec<dim>> list;
  for (const double t : times) list.push_back(tool.motion.velocity_at(t));
  return list;
}

/// The same as the nodes see it: at the start they may move as well.
template<int dim>
std::vector<Vec<dim>> approaches_of(const input::Case& input, const State<dim>& state,
                                    const contact::Tool<dim>& tool) {
  std::vector<Vec<dim>> list = velocities_of<dim>(input, tool);
  const Vec<dim> start = list.front();
  Vec<dim> fastest = start;
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const Vec<dim> seen = start - vector_at<dim>(state.node.velocity, i);
    if (seen.squaredNorm() > fastest.squaredNorm()) fastest = seen;
  }
  list.push_back(fastest);
  return list;
}

/// Dilatational waves of the material where they are slowest, with its scaled mass, m/s.
template<int dim>
double slowest_waves(const input::Case& input, const Model<dim>& model, std::string& material) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const plasticity::Material& own : model.materials)
    if (const double speed = own.elasticity.dilatational_speed(own.density); speed < slowest) {
      slowest = speed;
      material = own.name;
    }
  const auto& scaling = input.time.mass_scaling;
  return slowest / std::sqrt(scaling ? scaling->factor : 1.0);
}

/// How far a tool reaches along a direction, m.
template<int dim> double width_of(const input::Tool& tool, const Vec<dim>& direction) {
  if constexpr (dim == 2)
    return width_along(tool.outline, direction);
  else
    return std::numeric_limits<double>::infinity(); // a half-space
}

/// What is wrong with a tool at a velocity relative to what it meets; empty when nothing is. A velocity that
/// is not a number is wrong too.
template<int dim> std::string too_far(const input::Tool& tool, const Vec<dim>& velocity, double dt) {
  const double speed = velocity.stableNorm();
  if (speed == 0.0) return "";
  const double width = width_of<dim>(tool, velocity / speed);
  if (speed * dt <= width) return "";
  return fmt::format("{:.3g} m/s are {:.3g} m in a step of {:.3g} s, expected less than the {:.3g} m that it "
                     "is wide along its way: nodes would pass through it unseen",
                     speed, speed * dt, dt, width);
}

} // namespace

double width_along(const Curve& outline, const Vec2& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const CurvePiece& piece : outline.pieces) {
    const int samples = piece.is_arc() ? 64 : 1;
    for (int k = 0; k < samples; ++k) {
      const double reach = piece.point(static_cast<double>(k) / samples).dot(direction);
      low = std::min(low, reach);
      high = std::max(high, reach);
    }
  }
  return high - low;
}

template<int dim>
std::vector<std::string> supersonic_tools(const input::Case& input, const ExplicitSolver<dim>& solver) {
  std::vector<std::string> warnings;
  std::string material;
  const double sound = slowest_waves(input, solver.model(), material);
  for (const contact::Tool<dim>& tool : solver.conditions().contact.tools()) {
    double fastest = 0.0;
    for (const Vec<dim>& velocity : approaches_of<dim>(input, solver.state(), tool))
      fastest = std::max(fastest, velocity.norm());
    if (fastest > sound)
      warnings.push_back(fmt::format(
          "tools.{} and the workpiece meet at {:.4g} m/s, faster than sound in '{}' ({:.4g} m/s{}): shocks "
          "are "
          "smeared over a few nodes, and elasticity linear in logarithmic strain is no equation of state",
          tool.name, fastest, material, sound,
          input.time.mass_scaling && input.time.mass_scaling->factor > 1.0 ? " with its scaled mass" : ""));
  }
  return warnings;
}

template<int dim>
void check_tool_steps(const input::Case& input, const ExplicitSolver<dim>& solver, double dt) {
  dt = std::min(dt, input.time.end);
  const auto& tools = solver.conditions().contact.tools();
  for (std::size_t t = 0; t < tools.size(); ++t)
    for (const Vec<dim>& velocity : approaches_of<dim>(input, solver.state(), tools[t]))
      if (const std::string problem = too_far<dim>(input.tools[t], velocity, dt); !problem.empty())
        throw input.error(
            fmt::format("tools.{}", tools[t].name),
            fmt::format("{}; make it thicker, or the step shorter with time.step.max", problem));
}

template<int dim>
void check_moving_tools(const input::Case& input, const ExplicitSolver<dim>& solver, double dt) {
  dt = std::min(dt, input.time.end);
  const auto& contact = solver.conditions().contact;
  const State<dim>& state = solver.state();
  for (std::size_t t = 0; t < contact.tools().size(); ++t) {
    const std::string problem = too_far<dim>(input.tools[t], contact.velocity(t, state.time), dt);
    if (problem.empty()) continue;
    const contact::Box<dim> box = contact.tools()[t].shape->bounds();
    const Vec<dim> centre = 0.5 * (box.low + box.high) + contact.displacement(t, state.time);
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < state.node.size(); ++i)
      if (const double d = (vector_at<dim>(state.node.position, i) - centre).norm(); d < least) {
        least = d;
        nearest = static_cast<int>(i);
      }
    throw DivergenceError(fmt::format("tool '{}' is too fast at step {}, t = {:.6g} s: {}",
                                      contact.tools()[t].name, state.step, state.time, problem),
                          nearest, "tool velocity");
  }
}

template std::vector<std::string> supersonic_tools(const input::Case&, const ExplicitSolver<2>&);
template void check_tool_steps(const input::Case&, const ExplicitSolver<2>&, double);
template void check_moving_tools(const input::Case&, const ExplicitSolver<2>&, double);
template std::vector<std::string> supersonic_tools(const input::Case&, const ExplicitSolver<3>&);
template void check_tool_steps(const input::Case&, const ExplicitSolver<3>&, double);
template void check_moving_tools(const input::Case&, const ExplicitSolver<3>&, double);

} // namespace cnem::app
