#pragma once
// What fields, pictures and files are made from, whichever solver it comes from.
#include "core/fields/state.hpp"
#include "core/operators/discretisation.hpp"
#include "mechanics/explicit_solver.hpp"

namespace cnem::results {

/// A state with the approximation it lives on. References must outlive it.
template<int dim> struct Snapshot {
  const State<dim>& state;
  const Approximation<dim>& approximation;
  const Cloud<dim>& cloud;
  const contact::RigidContact<dim>& contact;
  const AdaptationFields* adaptation = nullptr; ///< null: the cloud is not adapted
  double displacement_scale = 1.0;              ///< pictures draw initial position + scale · displacement
  const std::vector<ToolSection<dim>>* tools = nullptr; ///< that conduct; null: not looked at
  const Fields<dim>* springback = nullptr;              ///< [k][node] m; null: not asked for, or not the end
};

template<int dim>
Snapshot<dim> snapshot(const ExplicitSolver<dim>& solver, const AdaptationFields* adaptation = nullptr) {
  return {.state = solver.state(),
          .approximation = solver.approximation(),
          .cloud = solver.conditions().cloud,
          .contact = solver.conditions().contact,
          .adaptation = adaptation,
          .tools = &solver.model().tool_sections};
}

} // namespace cnem::results
