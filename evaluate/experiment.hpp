#pragma once
// Computed forces beside measured ones: the two curves and how they differ. experiment.json in the folder of
// results.
#include "evaluate/blanking_result.hpp"
#include "input/case.hpp"
#include "results/history_writer.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::evaluate {

/// A curve of increasing x, linear between its points.
struct ComparedCurve {
  std::vector<double> x, y;
};

/// How two curves differ over the part of x that both have; not-a-number where there is none.
struct CurveDifference {
  double from = std::numeric_limits<double>::quiet_NaN(), to = from; ///< common part
  double peak_measured = from, peak_computed = from;                 ///< largest of each whole curve
  double at_measured = from, at_computed = from;                     ///< x there
  double area_measured = from, area_computed = from;                 ///< under them over the common part
  double rms = from; ///< root mean square of the difference over the common part

  bool common() const { return to > from; }
};

/// Exact for curves that are linear between points. measured has points; computed may have none.
CurveDifference compare_curves(const ComparedCurve& measured, const ComparedCurve& computed);

/// One measured curve and the computed one as the experiment would have measured it.
struct ExperimentResult {
  std::string name, tool, component;
  bool over_stroke = true;                       ///< else over time: no work
  std::string force_unit = "N", work_unit = "J"; ///< or N/m, J/m of cut
  double factor = 1.0;                           ///< computed forces are those of the model times it
  ComparedCurve measured, computed;              ///< m or s; N or N/m
  /// Both through one low-pass, over what both have: their difference is that of the forces themselves
  /// through it, also where these rise.
  ComparedCurve passed_measured, passed_computed;
  CurveDifference difference;
  std::string note; ///< what keeps them from being compared, or makes the numbers doubtful; empty otherwise
};

/// The curves of a case beside the history of its run. blanking: its cuts and their direction, where the case
/// evaluates them. Throws IoError where the history lacks columns.
std::vector<ExperimentResult> evaluate_experiments(const input::Case& input,
                                                   const results::HistoryTable& history,
                                                   const BlankingResult* blanking);

/// Named numbers for status.json, with units: "experiment.press.peak_computed[N]", …
std::vector<std::pair<std::string, double>> metrics_of(const std::vector<ExperimentResult>& experiments);

/// Written atomically to `folder`/experiment.json. Throws IoError.
void write_experiments(const std::filesystem::path& folder, const std::vector<ExperimentResult>& experiments);
/// Empty when there is no such file. Throws IoError when it cannot be read.
std::vector<ExperimentResult> read_experiments(const std::filesystem::path& folder);

} // namespace cnem::evaluate
