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

/// Limits along the path from stability_places.csv: at the speed of the case, and at the one of the chart
/// that bears most all along; none where the file is not there. Throws IoError.
std::optional<Chart> stability_along(const std::filesystem::path& folder, const results::RunStatus& status);

/// The numbers to see first; none of a run that is no stability analysis.
std::vector<Figure> stability_figures(const results::RunStatus& status, const results::ShownUnits& units);

} // namespace cnem::report
