#pragma once
// A laminate that is cut by one tool, put together of the cuts of its plies, each of which is cut alone:
// docs/cutting.md.
#include "report/chart.hpp"
#include "results/shown_units.hpp"
#include "study/batch.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

/// How the tool of a run cuts: those of the plies of a laminate are one.
struct CutConditions {
  double rake = 0.0;        ///< rad
  double feed = 0.0;        ///< m
  double speed = 0.0;       ///< m/s, the largest that is prescribed; of a driven tool that at its beginning
  double clearance = 0.0;   ///< rad
  double edge_radius = 0.0; ///< m; 0: sharp
  std::string friction;     ///< the tool's as the resolved case has it, in SI
};
/// None without [report.cutting].
std::optional<CutConditions> cut_conditions(const input::Case& input);

/// The run in which each ply of the laminate is cut, [ply]. Angles of fibres are the same when they differ by
/// half turns. Throws InputError for a ply that no run, or that several, are for, for runs without
/// [report.cutting], and for plies that are cut otherwise than the first; `cuts` [run].
std::vector<std::size_t> runs_of_plies(const Study& study, const std::vector<RunRecord>& runs,
                                       const std::vector<std::optional<CutConditions>>& cuts);

/// A number of status.json of each ply and its mean over the thickness.
struct LaminateColumn {
  std::string name, unit;
  std::vector<double> ply; ///< [ply], not-a-number: its run lacks it
  double mean = 0.0;       ///< not-a-number where that of a ply is
};

/// Numbers that are not known are not-a-number.
struct LaminateCut {
  double thickness = 0.0;            ///< m, of all plies
  std::vector<double> Fc, Ft;        ///< N, [ply]: of its share of the edge
  std::vector<double> Fc_peak;       ///< N, [ply]
  double Fc_sum = 0.0, Ft_sum = 0.0; ///< N
  double common = 0.0;               ///< m of cut that all plies have
  double peak = 0.0, peak_at = 0.0;  ///< N, m of cut: largest sum of the plies' filtered Fc there
  std::vector<double> damage_depth;  ///< m below the cut, [ply]: of fibres, matrix or bonds
  std::vector<double> delamination;  ///< m, [interface]: |difference| of the depths beside it
  std::vector<LaminateColumn> columns;
  report::Chart forces; ///< over the cut: the laminate's, and the share of each ply

  /// Whether the peak is not known because a chip is not off yet where the shortest cut of a ply ends.
  bool ends_early() const { return std::isfinite(common) && !std::isfinite(peak); }
};

/// Expects a study with a laminate whose plies are cut in `run` [ply]; `folder` holds the runs. Throws
/// IoError.
LaminateCut cut_of_laminate(const Study& study, const std::vector<RunRecord>& runs,
                            const std::vector<std::size_t>& run, const std::filesystem::path& folder);

/// laminate.csv: a row for each ply from above, in SI, with the indicator of the interface below it, and one
/// for all.
std::string laminate_table(const Study& study, const std::vector<std::size_t>& run, const LaminateCut& cut);

/// The section of the report.
std::string laminate_section(const Study& study, const std::vector<std::size_t>& run, const LaminateCut& cut,
                             const results::ShownUnits& units);

/// A line of text: what the laminate takes.
std::string laminate_line(const LaminateCut& cut);

} // namespace cnem::study
