#pragma once
// Whether tools are slow enough for their contact to be seen: in one step no further than they are thick, and
// slower than sound in the workpiece.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// Tools that meet the workpiece faster than its dilatational waves, at some time of the run or, where the
/// workpiece itself flies, at the start. One sentence each.
template<int dim>
std::vector<std::string> supersonic_tools(const input::Case& input, const ExplicitSolver<dim>& solver);

/// Throws InputError when a tool moves, at some time of the run, further than it is thick along its way in a
/// step of `dt` (s), or the workpiece does so past it at the start: nodes would pass through it unseen. What
/// else passes ends the run (contact/contact.hpp).
template<int dim>
void check_tool_steps(const input::Case& input, const ExplicitSolver<dim>& solver, double dt);

} // namespace cnem::app
