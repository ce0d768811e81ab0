#pragma once
// How a run tells that it means nothing any more, and what it says about it afterwards.
#include "core/error.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/status.hpp"

#include <string>

namespace cnem::app {

/// The node of a stress point, the first one for methods whose points are not nodes.
template<int dim> std::size_t node_of(const ExplicitSolver<dim>& solver, std::size_t point);

/// The stable step `dt` (s) at a stress point is below `least`, which is given in words.
template<int dim>
DivergenceError step_collapse(const ExplicitSolver<dim>& solver, std::size_t point, double dt,
                              const std::string& least);

/// Throws DivergenceError when a position, velocity or temperature is not a number.
template<int dim> void check_finite(const State<dim>& state);

/// Throws DivergenceError when the energy residual is more than the case allows, from step 10 on; it has no
/// place of its own: the fastest node shows where the run has come apart.
template<int dim>
void check_energy(double residual, const EnergyScale& scale, double tolerance, const State<dim>& state);

/// The reference could not be renewed: the place is the most strained cell.
template<int dim>
DivergenceError lost_reference(const ExplicitSolver<dim>& solver, const GeometryError& error);

/// Where and when, and the likely causes in plain words.
template<int dim>
results::PostMortem post_mortem(const DivergenceError& error, const input::Case& input,
                                const ExplicitSolver<dim>& solver);

/// The neighbourhood of a node to draw.
template<int dim> struct Place {
  Vec<dim> centre = Vec<dim>::Zero(); ///< m
  double radius = 0.0;                ///< m
};
template<int dim> Place<dim> place_of(const ExplicitSolver<dim>& solver, std::size_t node);

} // namespace cnem::app
