#pragma once
// What a node and step of the plane costs beyond those of one metal with a point a node.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

namespace cnem::app {

/// Processor time of one thread in a step, s: differences of runs of one block or cut that differ in what
/// stands on the right alone. How and where they were measured: docs/performance.md, "Costs of matter".
namespace step_costs {
inline constexpr double point = 45e-9;  ///< a stress point beyond one of each node
inline constexpr double entry = 2.7e-9; ///< an entry of the rows beyond those of natural neighbours
// Of a point, to what one of a metal in plane strain costs:
inline constexpr double elastic_sheet = 20e-9; ///< isotropic, without stress out of the plane
inline constexpr double flowing_sheet = 70e-9; ///< the same with a flow stress
inline constexpr double ply = 115e-9;
inline constexpr double flowing_ply = 85e-9; ///< to that of a ply: with a flow stress
inline constexpr double failing_ply = 90e-9; ///< the same: with max-stress or Hashin
inline constexpr double planes_ply = 430e-9; ///< the same: with LaRC02, which searches planes of fracture
// Of a run of points of one material between those of others:
inline constexpr double run = 320e-9;       ///< isotropic
inline constexpr double sheet_run = 550e-9; ///< the same without stress out of the plane
inline constexpr double ply_run = 50e-9;
inline constexpr double flowing_ply_run = 250e-9;
inline constexpr double bond = 130e-9;   ///< an element of a cohesive interface
inline constexpr double debris = 130e-9; ///< a node, contact of bodies that come off at interfaces
/// –, passes of such bodies, each of which is triangulated for itself, over those of one.
inline constexpr double passes_of_debris = 1.7;
} // namespace step_costs

/// Whether bodies come off at cohesive interfaces, break and rub on each other.
bool leaves_debris(const input::Case& input, const ExplicitSolver<2>& solver);

/// The mean over the nodes there are, s.
double added_cost_of_steps(const input::Case& input, const ExplicitSolver<2>& solver);

} // namespace cnem::app
