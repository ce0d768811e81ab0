#pragma once
// Newmark's scheme, paper 004, (11)-(15), with α = 1/4 and δ = 1/2: second order, unconditionally stable,
// keeps the energy of an undamped structure.
#include "core/sparse_cholesky.hpp"

namespace cnem::machining {

/// Coordinates and their rates, [unknowns].
struct Motion {
  Eigen::VectorXd q, velocity, acceleration;
};

/// M, C, K of one state of a part.
struct Matrices {
  SparseMatrix mass, damping, stiffness; ///< kg, N s/m, N/m
};

struct NewmarkStep {
  explicit NewmarkStep(double dt); ///< s

  double dt;                     ///< s
  double a0, a1, a2, a3, a4, a5; ///< (14), (15)

  /// K̂ (12), of matrices of the same pattern.
  SparseMatrix effective(const Matrices& of) const;
  /// Q̄ of the motion at the begin of the step (13).
  Eigen::VectorXd carried(const Motion& from, const Matrices& of) const;
  /// The motion that has come to q at the end of the step.
  Motion arrive(const Motion& from, Eigen::VectorXd q) const;
};

} // namespace cnem::machining
