#pragma once
// What fields, pictures and files are made from, whichever solver it comes from.
#include "core/discretisation.hpp"
#include "core/state.hpp"
#include "mechanics/explicit_solver.hpp"

namespace cnem::app {

/// A state with the approximation it lives on. References must outlive it.
struct Snapshot {
  const State<2>& state;
  const Approximation<2>& approximation;
  const Fields<2>& initial_position; ///< [k][node] m
  const Cloud<2>& cloud;
  const contact::RigidContact<2>& contact;
  double displacement_scale = 1.0; ///< pictures draw initial position + scale · displacement
};

inline Snapshot snapshot(const ExplicitSolver<2>& solver) {
  return {solver.state(), solver.approximation(), solver.initial_position(), solver.model().cloud,
          solver.model().contact};
}

} // namespace cnem::app
