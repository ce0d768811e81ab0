#pragma once
// A parameter study: one process per run, a manifest to go on from, one table and one report.
#include "core/error.hpp"
#include "results/status.hpp"
#include "study/study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

struct SweepOptions {
  std::filesystem::path output;                     ///< folder of results
  bool force = false;                               ///< run all again
  int processes = 0;                                ///< 0: what the study says
  std::filesystem::path program = "/proc/self/exe"; ///< cnem
  std::string version;
};

/// Where a run of a study stands.
struct SweepRun {
  enum class State { pending, done, failed };
  State state = State::pending;
  std::string inputs; ///< hash of the resolved case
  bool interrupted =
      false;    ///< its folder has a checkpoint of an earlier sweep with these inputs to go on from
  int exit = 0; ///< exit code of the process; −1 when a signal killed it
  std::string reason;
  std::optional<results::RunStatus> status; ///< of runs that are done
};

/// Runs what the folder does not hold yet and writes manifest.json, table.csv and report.html. Runs that were
/// interrupted (stopped, killed, or denied to write) with the same inputs go on from their last checkpoint;
/// others start anew. All cases are read before any starts. Returns done; diverged when a run failed, for
/// whatever reason; interrupted after SIGINT, SIGTERM or SIGHUP. Throws InputError and IoError.
Exit sweep(const Study& study, const SweepOptions& options);

/// Names of the numbers that the table shows: those of the study, or nodes, steps, energy_residual and all
/// metrics.
std::vector<std::string> table_columns(const Study& study, const std::vector<SweepRun>& runs);

/// A number of a status by its dotted name: "nodes", "metrics.K_I.right". None when the status lacks it.
std::optional<double> status_number(const results::RunStatus& status, const std::string& name);

/// table.csv: name, values of the keys, state, exit code and the columns of each run; numbers round-trip, and
/// texts that a spreadsheet would take for formulas begin with an apostrophe.
std::string sweep_table(const Study& study, const std::vector<SweepRun>& runs);

/// report.html: the charts, the histories in `folder`, and the table with links to the report of each run.
std::string sweep_report(const Study& study, const std::vector<SweepRun>& runs,
                         const std::filesystem::path& folder, const std::string& version);

} // namespace cnem::study
