#pragma once
// One static solution of a case, with stress intensity factors where there are cracks.
#include "app/run.hpp"
#include "input/case.hpp"

namespace cnem::app {

/// Solves the case and writes its folder: fields, history (one row), pictures, status.json with K_I, K_II of
/// every tip, report. Throws InputError (a missing support is named) and IoError.
Exit run_static(const input::Case& input, const RunOptions& options);

/// Builds geometry, prints nodes, unknowns, crack tips with the domains they are evaluated in, and what is
/// held.
void check_static(const input::Case& input, const RunOptions& options);

} // namespace cnem::app
