#pragma once
// The bands that the indicator refines in a blank, and when they begin.
#include "app/forecast/wanted_nodes.hpp"
#include "evaluate/blanking.hpp"
#include "mechanics/explicit_solver.hpp"

namespace cnem::app {

/// The cuts that a case makes: those that it reports, else between the tools that would be reported by
/// default. Empty where no punch moves against a die.
std::vector<evaluate::Clearance> foretold_cuts(const input::Case& input, const ExplicitSolver<2>& solver);

struct RefinedBands {
  double nodes = 0.0;  ///< of the whole cloud
  double finest = 0.0; ///< m, spacing of a few cells between the edges of the tools
};
/// What an indicator makes of a cloud of `count` nodes that has `first` beside tools, with a band for each
/// cut. Cells in it are of the finest rung that marking reaches, which may be wider than `h_min`; it is as
/// wide as marking asks for that rung. The field falls by e in a tenth of the thickness on both sides of the
/// clearance, and within half of the clearance between the edges; a cell of spacing h errs by 0.245 h² |∇f|
/// in the norm of L2, and may err by tolerance ‖f‖/√N of N nodes.
RefinedBands refined_bands(const input::Case& input, const std::vector<evaluate::Clearance>& cuts,
                           const WantedNodes& wanted, const adapt::Structure& structure, double first,
                           double count);

/// When metal begins to flow through the thickness, s: the punch has gone a thickness times the shear strain
/// of yield beyond where it met the sheet. time.end where it does not; 0 for punches that forces drive.
double flow_begins(const input::Case& input, const ExplicitSolver<2>& solver, const evaluate::Clearance& cut);

} // namespace cnem::app
