#include "app/plausibility/plausibility.hpp"

#include "app/plausibility/list.hpp"
#include "input/curve_checks.hpp"

#include <algorithm>
#include <limits>

namespace cnem::app {

double adapted_spacing(const input::Case& input) {
  double finest = std::numeric_limits<double>::infinity();
  if (!input.adapt.resample) return finest;
  if (input.adapt.tool_spacing) finest = std::min(finest, *input.adapt.tool_spacing);
  if (input.adapt.surface_spacing) finest = std::min(finest, *input.adapt.surface_spacing);
  if (input.adapt.indicator) finest = std::min(finest, input.adapt.h_min);
  return finest;
}

std::vector<const plasticity::Material*> materials_in_use(const input::Case& input) {
  std::vector<const plasticity::Material*> list;
  for (const plasticity::Material& material : input.materials) {
    const auto holds = [&](const input::Region& region) { return region.material == material.name; };
    if (material.name == input.domain.material ||
        std::any_of(input.domain.regions.begin(), input.domain.regions.end(), holds))
      list.push_back(&material);
  }
  return list;
}

double smaller_side(const input::Case& input) {
  const auto [low, high] = input::bounds(input.domain.outer);
  return (high - low).minCoeff();
}

template<int dim> bool waits_for_tools(const input::Case& input, const ExplicitSolver<dim>& solver) {
  for (const Field& component : solver.state().node.velocity)
    if (std::any_of(component.begin(), component.end(), [](double v) { return v != 0.0; })) return false;
  return std::none_of(input.boundary.begin(), input.boundary.end(), [](const auto& condition) {
    return input::moves(condition.velocity) || input::moves(condition.displacement);
  });
}

template bool waits_for_tools(const input::Case&, const ExplicitSolver<2>&);
template bool waits_for_tools(const input::Case&, const ExplicitSolver<3>&);

std::vector<std::string> doubts(const input::Case& input) {
  Doubts list;
  doubt_materials(input, list);
  doubt_heat(input, list);
  doubt_damage(input, list);
  doubt_friction(input, list);
  doubt_cutting(input, list);
  doubt_output(input, list);
  return list;
}

template<int dim>
std::vector<std::string> doubts(const input::Case& input, const ExplicitSolver<dim>& solver) {
  Doubts list = doubts(input);
  doubt_motions(input, solver, list);
  doubt_edges(input, solver, list);
  doubt_supports(input, solver, list);
  if constexpr (dim == 2) {
    doubt_pushes(input, solver, list);
    doubt_fracture(input, solver, list);
    doubt_interfaces(input, solver, list);
    doubt_parts(input, solver, list);
  }
  return list;
}

template std::vector<std::string> doubts(const input::Case&, const ExplicitSolver<2>&);
template std::vector<std::string> doubts(const input::Case&, const ExplicitSolver<3>&);

} // namespace cnem::app
