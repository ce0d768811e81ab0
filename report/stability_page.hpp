#pragma once
// Lobes of stability, as a page and a picture show them.
#include "report/chart.hpp"
#include "report/headline.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace cnem::report {

/// Limits over the speed from stability.csv, with the case's point; none where the file is not there. Throws
/// IoError.
std::optional<Chart> stability_lobes(const std::filesystem::path& folder, const results::RunStatus& status);

/// The numbers to see first; none of a run that is no stability analysis.
std::vector<Figure> stability_figures(const results::RunStatus& status, const results::ShownUnits& units);

} // namespace cnem::report
