#pragma once
// What a run of a case will take: nodes, steps, time. For people who decide whether to start it.
#include "app/time_control.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"

#include <optional>

namespace cnem::app {

struct Forecast {
  double finest = 0.0;             ///< m, spacing of the cells that limit the step
  std::optional<double> indicated; ///< m, the finest that the indicator comes to; none: no cut is foretold
  double nodes_first = 0.0;        ///< when the run has begun: near tools and where it flows
  double nodes_last = 0.0;         ///< at its end
  double nodes_mean = 0.0;         ///< over the steps
  double steps = 0.0;
  double seconds = 0.0; ///< of one thread
};

/// Of a solver at its start, whose stable step `control` has looked at. The step is that of the cells there
/// are, shorter in proportion where adaptation makes finer ones and when it does, but not than mass scaling
/// asks for. How good it is says docs/cutting.md.
template<int dim>
Forecast forecast(const input::Case& input, const ExplicitSolver<dim>& solver, const StepControl& control);

} // namespace cnem::app
