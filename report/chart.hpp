#pragma once
// Line charts as SVG text, and the standard charts of a history file.
#include "results/history_writer.hpp"
#include "results/shown_units.hpp"

#include <string>
#include <vector>

namespace cnem::report {

struct ChartSeries {
  std::string label;        ///< in the legend; empty: not listed there
  std::vector<double> x, y; ///< base units of the axes; gaps where a value is not finite
  int colour = 0;           ///< index into the palette; beyond its end dashed
  bool faint = false;       ///< drawn thin and pale, behind the others: raw data
  bool dashed = false;
};

struct Chart {
  std::string title;
  std::string x_label = "time", x_unit = "s"; ///< base units: a prefix is chosen from the data
  std::string y_label, y_unit;
  std::vector<ChartSeries> series;
  bool log_x = false, log_y = false;
  std::string note; ///< below the chart: how a filter works, what a sign means
};

/// The chart as one <svg> element with text as text, its axes in the units chosen. Long series are thinned to
/// what the eye can see (extremes kept).
std::string svg_chart(const Chart& chart, const results::ShownUnits& units = {});

/// The chart as an SVG file of its own, with its colours on white.
std::string svg_file(const Chart& chart, const results::ShownUnits& units = {});

/// Force against stroke per tool (raw and filtered), energies, residual, step size, extremes, probes:
/// whatever columns the history has, but for what never changes.
std::vector<Chart> history_charts(const results::HistoryTable& history,
                                  const results::ShownUnits& units = {});

} // namespace cnem::report
