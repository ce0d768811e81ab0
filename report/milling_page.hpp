#pragma once
// A milling cut in the time domain, as a page shows it.
#include "report/chart.hpp"
#include "report/headline.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <vector>

namespace cnem::report {

/// Forces, chip and vibration of the last two turns, spectra of the turns that stand for the cut, from
/// spectra.csv, with harmonics of the teeth and the frequency of chatter, energies, and what is left on the
/// machined side, from surface.csv; none where the latter file is not there. Throws IoError.
std::vector<Chart> milling_charts(const std::filesystem::path& folder, const results::HistoryTable& history,
                                  const results::RunStatus& status);

/// The numbers to see first; none of a run that is no milling analysis.
std::vector<Figure> milling_figures(const results::RunStatus& status, const results::ShownUnits& units);

} // namespace cnem::report
