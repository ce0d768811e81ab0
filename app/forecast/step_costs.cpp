#include "app/forecast/step_costs.hpp"

#include <algorithm>

namespace cnem::app {

namespace {

double cost_of_point(const plasticity::Material& material, bool sheet) {
  if (!material.ply)
    return !sheet ? 0.0 : material.hardening ? step_costs::flowing_sheet : step_costs::elastic_sheet;
  double cost = step_costs::ply;
  if (material.hardening) cost += step_costs::flowing_ply;
  if (material.failure)
    cost += material.failure->criterion == plasticity::FailureCriterion::larc02 ? step_costs::planes_ply
                                                                                : step_costs::failing_ply;
  return cost;
}

double cost_of_run(const plasticity::Material& material, bool sheet) {
  if (material.ply) return material.hardening ? step_costs::flowing_ply_run : step_costs::ply_run;
  return sheet ? step_costs::sheet_run : step_costs::run;
}

} // namespace

bool leaves_debris(const input::Case& input, const ExplicitSolver<2>& solver) {
  return input.contact.active && input.adapt.separate && !solver.conditions().cohesive.empty();
}

double added_cost_of_steps(const input::Case& input, const ExplicitSolver<2>& solver) {
  const Model<2>& model = solver.model();
  const DiscreteOperators<2>& rows = solver.approximation().mechanics;
  constexpr double neighbours = 10.0; // natural ones have fewer in the mean
  const double nodes = rows.nodes, entries = static_cast<double>(rows.node.size());
  double cost = step_costs::point * (rows.points - nodes) +
                step_costs::entry * std::max(0.0, entries - neighbours * nodes);
  plasticity::for_each_run(
      model.materials, solver.state().point.material, 0, rows.points,
      [&](const plasticity::Material& material, std::ptrdiff_t first, std::ptrdiff_t stop) {
        cost += static_cast<double>(stop - first) * cost_of_point(material, model.plane_stress);
        if (stop - first < rows.points) cost += cost_of_run(material, model.plane_stress);
      });
  for (const CohesiveInterface& interface : solver.conditions().cohesive.interfaces())
    cost += step_costs::bond * static_cast<double>(interface.element.size());
  return cost / nodes + (leaves_debris(input, solver) ? step_costs::debris : 0.0);
}

} // namespace cnem::app
