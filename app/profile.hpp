#pragma once
// Where the wall time of a run went, as a table.
#include "results/status.hpp"

#include <string>

namespace cnem::app {

/// One line a phase: seconds, share of the total, and nanoseconds per node and step ("-" when there were no
/// steps). Parts of a phase stand indented below it; phases that took no time are left out.
std::string profile_table(const results::RunStatus& status);

} // namespace cnem::app
