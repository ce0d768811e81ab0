#pragma once
// Charts of a parameter study.
#include "report/chart.hpp"
#include "study/batch.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cnem::study {

/// The charts that a study asks for. Where it asks for none and its cases evaluate a cut, one of each number
/// of the cut over the first axis.
std::vector<report::Chart> column_charts(const Study& study, const std::vector<RunRecord>& runs);

/// The columns of histories that a study asks for; where it asks for none and its cases evaluate a cut, the
/// force of the punch over its stroke. `folder` holds those of the runs.
std::vector<report::Chart> history_charts(const Study& study, const std::vector<RunRecord>& runs,
                                          const std::filesystem::path& folder);

} // namespace cnem::study
