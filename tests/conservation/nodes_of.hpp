#pragma once
// What resampling has to know of the nodes of a solver.
#include "adapt/plane/working_cloud.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"

#include <functional>

namespace cnem::testing {

/// Nothing is held; wanted: m, the spacing at a node that began at X (m).
inline adapt::NodeProperties nodes_of(const ExplicitSolver<2>& solver,
                                      const std::function<double(const Vec2&)>& wanted) {
  const State<2>& state = solver.state();
  adapt::NodeProperties node;
  node.mass = state.node.mass;
  for (std::size_t i = 0; i < node.mass.size(); ++i) {
    node.jacobian.push_back(jacobian<2>(state.point.deformation, i) / state.point.stress_free[i]);
    node.density.push_back(solver.model().materials[0].density);
    node.size.push_back(wanted({state.node.initial_position[0][i], state.node.initial_position[1][i]}));
    node.held.push_back(0);
  }
  return node;
}

} // namespace cnem::testing
