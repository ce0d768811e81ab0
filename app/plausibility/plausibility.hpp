#pragma once
// What a case allows and its writer hardly means, before anything has moved: units a thousand times off,
// tools that move away, cells too coarse for what they should show.
#include "evaluate/blanking.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// One sentence each, with its reason and what to write instead, behind the place of the key in the case.
std::vector<std::string> doubts(const input::Case& input); ///< of the case alone
template<int dim>
std::vector<std::string> doubts(const input::Case& input, const ExplicitSolver<dim>& solver);

/// How far the punch is led against the mean of the dies by the time t, m.
Vec2 led_stroke(const ExplicitSolver<2>& solver, const input::BlankingReport& asked, double t);

/// Of a cut between the tools that `asked` names, at the start; none where nothing moves or lies between.
std::vector<evaluate::Clearance> clearances(const input::Case& input, const ExplicitSolver<2>& solver,
                                            const input::BlankingReport& asked);

/// Lengths that decide about a cut, {label, text}: clearances in mm and in parts of the thickness, gaps
/// between tools and workpiece, radii of edges over spacings. Of the plane.
std::vector<std::pair<std::string, std::string>> tool_measures(const input::Case& input,
                                                               const ExplicitSolver<2>& solver);

} // namespace cnem::app
