#include "app/watches/tool_speed.hpp"

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
  std::vector<double> times{0.0, input.time.end};
  for (const TimeTable& speed : tool.motion.velocity)
    for (const double t : speed.times())
      if (t > 0.0 && t < input.time.end) times.push_back(t);
  std::vector<Vec<dim>> list;
  for (const double t : times) list.push_back(tool.led_velocity(t));
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
    if (const double speed = own.fastest_wave(); speed < slowest) {
      slowest = speed;
      material = own.name;
    }
  const auto& scaling = input.time.mass_scaling;
  return slowest / std::sqrt(scaling ? scaling->factor : 1.0);
}

} // namespace

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
  for (const contact::Tool<dim>& tool : solver.conditions().contact.tools())
    for (const Vec<dim>& velocity : approaches_of<dim>(input, solver.state(), tool)) {
      const double speed = velocity.stableNorm();
      if (speed == 0.0) continue;
      const double thickness = tool.shape->thickness_along(velocity / speed);
      if (speed * dt <= thickness) continue; // false as well where the speed is not a number
      throw input.error(
          fmt::format("tools.{}", tool.name),
          fmt::format("{:.3g} m/s are {:.3g} m in a step of {:.3g} s, expected less than the {:.3g} m that "
                      "it is thick along its way: nodes would pass through it unseen; make it thicker, or "
                      "the step shorter with time.step.max",
                      speed, speed * dt, dt, thickness));
    }
}

template std::vector<std::string> supersonic_tools(const input::Case&, const ExplicitSolver<2>&);
template void check_tool_steps(const input::Case&, const ExplicitSolver<2>&, double);
template std::vector<std::string> supersonic_tools(const input::Case&, const ExplicitSolver<3>&);
template void check_tool_steps(const input::Case&, const ExplicitSolver<3>&, double);

} // namespace cnem::app
