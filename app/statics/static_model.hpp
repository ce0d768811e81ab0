#pragma once
// A static problem made ready, solved, and looked at.
#include "app/problem/registry.hpp"
#include "app/statics/cracks.hpp"
#include "mechanics/statics/statics.hpp"

#include <string>
#include <type_traits>

namespace cnem::app {

/// Bodies in space have no crack tips: a front is a line.
struct NoCracks {
  NoCracks(const input::Case&, const Cloud<3>&, const Approximation<3>&) {}
};

/// What a static analysis works on.
template<int dim> struct StaticModel {
  explicit StaticModel(const input::Case& input);

  StaticProblem<dim> problem() const;
  /// Columns are nodes, and behind them the functions that enrich crack tips.
  const DiscreteOperators<dim>& operators() const;
  const StabilisationLinks<dim>& links() const;

  const input::Case& input;
  Setup<dim> setup;
  Approximation<dim> approximation;
  std::conditional_t<dim == 2, Cracks, NoCracks> cracks;
  Fields<dim> position; ///< [k][node] m
  Fields<dim> force;    ///< [k][function] N/m^(3−dim)
};

bool plane_stress(const input::Case& input);

/// Says how much of the body would flow; empty while nothing does.
template<int dim>
std::string beyond_yield(const StaticModel<dim>& model, const StaticSolution<dim>& solution);

/// The solution as a state: positions X + u, and stresses averaged over each cell, kept so that their Cauchy
/// stress is the linear one.
template<int dim> State<dim> as_state(const StaticModel<dim>& model, const StaticSolution<dim>& solution);

extern template struct StaticModel<2>;
extern template struct StaticModel<3>;

} // namespace cnem::app
