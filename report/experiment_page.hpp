#pragma once
// The part of report.html on experiments: measured curves over computed ones, and how they differ.
#include "evaluate/experiment.hpp"
#include "report/chart.hpp"

#include <string>
#include <vector>

namespace cnem::report {

/// Measured and computed force of one experiment, in mm (or ms) and kN (or N, N/mm).
Chart experiment_chart(const evaluate::ExperimentResult& result);

/// Charts and tables as HTML; empty when there is nothing to show.
std::string render_experiments(const std::vector<evaluate::ExperimentResult>& experiments);

} // namespace cnem::report
