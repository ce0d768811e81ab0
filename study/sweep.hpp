#pragma once
// A parameter study: one process per run, a manifest to go on from, one table and one report.
#include "study/batch.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

enum class SweepWork { run, merge };

/// Runs a study as run_batch() does, or merges what is there, as merge_batch() does. All cases are read
/// before any starts.
Exit sweep(const Study& study, const BatchOptions& options, SweepWork work = SweepWork::run);

/// Names of the numbers that the table shows: those of the study, or nodes, steps, energy_residual and those
/// of a cut where the cases evaluate one, else all metrics.
std::vector<std::string> table_columns(const Study& study, const std::vector<RunRecord>& runs);

/// A number of a status by its dotted name: "nodes", "metrics.K_I.right". None when the status lacks it.
std::optional<double> status_number(const results::RunStatus& status, const std::string& name);

/// The unit of such a number, SI; "" where it has none or no run is done.
std::string column_unit(const std::vector<RunRecord>& runs, const std::string& name);

/// What users ask of a cut: largest force of the punch, stroke there, work, and the zones of the faces.
std::vector<std::string> cut_columns(const std::vector<RunRecord>& runs);

/// What the curves of charts that are extrapolated come to at x = 0, a line of text each: the straight line
/// through the two points nearest to it, for errors in proportion to a spacing. Curves of one point have
/// none.
std::string extrapolations(const Study& study, const std::vector<RunRecord>& runs);

/// table.csv, as csv_table() writes it.
std::string sweep_table(const Study& study, const std::vector<RunRecord>& runs);

/// What runs that are done were warned of, "run: text"; what several were warned of in the same words once.
std::vector<std::string> warnings_of_runs(const Study& study, const std::vector<RunRecord>& runs);

/// report.html: `first`, the charts, the histories in `folder`, and the table with links to the report of
/// each run.
std::string sweep_report(const Study& study, const std::vector<RunRecord>& runs,
                         const std::filesystem::path& folder, const std::string& version,
                         const std::string& first = "");

} // namespace cnem::study
