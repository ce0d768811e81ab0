#pragma once
// The runs of a study as processes: a folder and a log for each, a manifest to go on from, and the files that
// show them together.
#include "core/error.hpp"
#include "input/case.hpp"
#include "results/status.hpp"
#include "study/part.hpp"
#include "study/study.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::study {

struct BatchOptions {
  std::filesystem::path output;                     ///< folder of results
  bool force = false;                               ///< run all again
  int processes = 0;                                ///< 0: what the study says
  std::filesystem::path program = "/proc/self/exe"; ///< cnem
  std::string version;
  std::optional<Part> only{}; ///< of the runs; others work at the rest, perhaps now
};

/// Where a run of a study stands.
struct RunRecord {
  /// refused: its method cannot give what the case asks for.
  enum class State { pending, done, failed, refused };
  State state = State::pending;
  std::string inputs; ///< hash of the resolved case
  bool interrupted =
      false;    ///< its folder has a checkpoint of an earlier call with these inputs to go on from
  int exit = 0; ///< exit code of the process; −1 when a signal killed it
  std::string reason;
  std::optional<results::RunStatus> status; ///< of runs that are done
  std::vector<input::Variable> variables{}; ///< of its case
  std::string punch{};                      ///< tool whose cut [report.blanking] evaluates, or empty
};
const char* state_name(RunRecord::State state);

/// What a run depends on, as a hash.
std::string inputs_of(const input::Case& input);

/// A run as a process.
struct RunOrder {
  std::filesystem::path case_file;
  std::vector<input::Override> changes;
  std::filesystem::path folder;
  bool interrupted = false; ///< it goes on from its last checkpoint
  int threads = 1;          ///< 0: as a run takes by itself
};
std::vector<std::string> run_command(const RunOrder& order, const std::filesystem::path& program);
/// The file beside a folder of results that takes what the run prints, and its last line.
std::filesystem::path log_of(const std::filesystem::path& folder);
std::string last_line(const std::filesystem::path& log);

/// How many processes: those that are wanted, or as many as there are cores for runs of so many threads.
std::size_t processes_for(int wanted, int threads);

/// Whether a folder holds the manifest of an earlier call of this kind. Throws InputError where it holds a
/// run, or the runs of another kind; IoError, unless `force`, where its manifest is none.
bool holds_manifest(const std::filesystem::path& folder, const std::string& kind, bool force);
/// Throws IoError.
void make_folder(const std::filesystem::path& folder);

struct PageTexts {
  std::string table, report;
  std::vector<std::pair<std::string, std::string>> more{}; ///< names and texts of other files
};

/// What shows the runs together.
struct Pages {
  std::string kind;          ///< in words: "sweep"
  std::string table, report; ///< names of the files
  std::function<PageTexts(const std::vector<RunRecord>&)> write;
  /// Prints what users shall see in the end: results, and what they may have misspelt.
  std::function<void(const std::vector<RunRecord>&)> tell = nullptr;
};

/// Runs what the folder does not hold yet and writes manifest.json, the table and the report. Runs that were
/// interrupted (stopped, killed, or denied to write) with the same inputs go on from their last checkpoint;
/// others start anew. Returns done; diverged when a run failed, for whatever reason; else bad_input when one
/// was refused; interrupted after SIGINT, SIGTERM or SIGHUP. Throws InputError, for a folder that holds
/// something else too, and IoError.
///
/// A part (options.only) shares the folder with others at work there: it notes where each of its runs stands
/// in a file NAME.part.json, which counts for more than the manifest, and writes no table and no report. The
/// next call for the whole takes these notes into the manifest.
Exit run_batch(const Study& study, std::vector<RunRecord> runs, const BatchOptions& options,
               const Pages& pages);

/// Writes the table and the report of the runs that the folder holds and runs nothing; parts may be at work
/// there. Returns done when all are done; diverged when one failed; interrupted when some are not done yet.
/// Throws InputError, also for a folder without runs, and IoError.
Exit merge_batch(const Study& study, std::vector<RunRecord> runs, const BatchOptions& options,
                 const Pages& pages);

} // namespace cnem::study
