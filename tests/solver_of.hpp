#pragma once
// The solver of a case, as a run begins with it.
#include "app/simulation.hpp"

namespace cnem::testing {

/// What it would be warned of is left aside. Throws as app::make_solver.
template<int dim = 2> ExplicitSolver<dim> solver_of(const input::Case& input) {
  std::vector<std::string> warnings;
  return app::make_solver<dim>(input, warnings);
}

} // namespace cnem::testing
