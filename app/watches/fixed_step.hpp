#pragma once
// A step that a case fixes, beside the one that is stable.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// One sentence where `time.step.fixed` is longer than the stable step of the solver as it is; none
/// otherwise.
template<int dim>
std::vector<std::string> unstable_fixed_step(const input::Case& input, ExplicitSolver<dim>& solver);

} // namespace cnem::app
