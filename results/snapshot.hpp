#pragma once
// What fields, pictures and files are made from, whichever solver it comes from.
#include "core/discretisation.hpp"
#include "core/state.hpp"
#include "mechanics/explicit_solver.hpp"

namespace cnem::results {

/// What adaptation says of the nodes; each list is [node].
struct AdaptationFields {
  Field level;     ///< – log2 of the spacing of the case over the wanted one
  Field indicator; ///< of the last new reference
  Field age;       ///< s, since the node was inserted
};

/// A state with the approximation it lives on. References must outlive it.
struct Snapshot {
  const State<2>& state;
  const Approximation<2>& approximation;
  const Fields<2>& initial_position; ///< [k][node] m
  const Cloud<2>& cloud;
  const contact::RigidContact<2>& contact;
  const AdaptationFields* adaptation = nullptr; ///< null: the cloud is not adapted
  double displacement_scale = 1.0;              ///< pictures draw initial position + scale · displacement
  const Fields<2>* springback = nullptr;        ///< [k][node] m; null: not asked for, or not the end
};

inline Snapshot snapshot(const ExplicitSolver<2>& solver, const AdaptationFields* adaptation = nullptr) {
  return {solver.state(),       solver.approximation(), solver.initial_position(),
          solver.model().cloud, solver.model().contact, adaptation};
}

} // namespace cnem::results
