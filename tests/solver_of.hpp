#pragma once
// The solver of a case, as a run begins with it.
#include "app/simulation.hpp"

namespace cnem::testing {

/// What it would be warned of is left aside. Throws as app::make_solver.
inline ExplicitSolver<2> solver_of(const input::Case& input) {
  std::vector<std::string> warnings;
  return app::make_solver<2>(input, warnings);
}

} // namespace cnem::testing
