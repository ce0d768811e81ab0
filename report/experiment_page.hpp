#pragma once
// The part of report.html on experiments: measured curves over computed ones, and how they differ.
#include "evaluate/experiment.hpp"
#include "report/chart.hpp"

#include <string>
#include <vector>

namespace cnem::report {

/// Measured and computed force of one experiment, in SI; lengths of its note in the units.
Chart experiment_chart(const evaluate::ExperimentResult& result, const results::ShownUnits& units = {});

/// Charts and tables as HTML, in mm, ms and kN (or N, N/mm) where no other units are chosen; empty when there
/// is nothing to show.
std::string render_experiments(const std::vector<evaluate::ExperimentResult>& experiments,
                               const results::ShownUnits& units = {});

} // namespace cnem::report
