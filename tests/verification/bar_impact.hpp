#pragma once
// Elastic bars that collide along their axis: the force ρ c v A for the time 2 L/c.
#include "tests/unit/mechanics/models.hpp"

#include <functional>
#include <gtest/gtest.h>

namespace cnem::testing {

/// Runs to 1.4 times the duration of the contact, which begins at `meet`; `force` is that of the step, N/m.
inline void expect_bar_impact(ExplicitSolver<2>& solver, double meet, double duration, double expected,
                              const std::function<double()>& force) {
  const double dt = solver.stable_step().dt;
  double plateau = 0.0, last_contact = 0.0;
  int samples = 0;
  while (solver.state().time < meet + 1.4 * duration) {
    solver.advance(dt);
    const double t = solver.state().time - meet, pushing = force();
    if (t > 0.2 * duration && t < 0.8 * duration) {
      plateau += pushing;
      ++samples;
    }
    if (pushing > 0.5 * expected) last_contact = t;
  }
  EXPECT_NEAR(plateau / samples, expected, 0.01 * expected);
  EXPECT_NEAR(last_contact, duration, 0.03 * duration);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger().initial());
}

} // namespace cnem::testing
