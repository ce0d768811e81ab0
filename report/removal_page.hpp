#pragma once
// What a report shows of a part while a tool takes matter from it.
#include "report/chart.hpp"
#include "results/history_writer.hpp"

#include <vector>

namespace cnem::report {

/// Displacements of its points over time, how far they are from those with K̂(t) itself, and the energies;
/// none where the history is of another analysis.
std::vector<Chart> removal_charts(const results::HistoryTable& history);

} // namespace cnem::report
