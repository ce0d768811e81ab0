#pragma once
// Runs of a case: to their end, as the command line asks for them, or in pieces within another program.
#include "app/observer.hpp"
#include "input/case.hpp"
#include "results/folder_lock.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cnem::app {

struct RunOptions {
  std::filesystem::path output; ///< folder of results; empty: nothing is written
  bool force = false;           ///< replace a run that is there
  int threads = 0;              ///< 0: what OpenMP takes by itself
  std::string version;
  bool profile = false;      ///< tell where the time went
  bool keep_history = false; ///< rows of the history stay in memory beside the file
};

/// A run that goes on in pieces.
class Session {
public:
  virtual ~Session() = default;
  /// Goes on to the end, or until it diverges, writing fails or the observer stops it: done, diverged,
  /// io_failed, interrupted; then the status and, in a folder, the report are made. None when the observer
  /// asked for a pause. Goes on after that, and where a run without a folder was stopped; otherwise calling
  /// again changes nothing. Throws InputError for what only shows in a solution.
  virtual std::optional<Exit> go_on() = 0;
  /// As it stands.
  virtual results::RunStatus status() = 0;
  /// Good until the run goes on.
  virtual std::variant<results::Snapshot<2>, results::Snapshot<3>> snapshot() = 0;
  virtual const results::HistoryLog& history() const = 0;
};

/// A run of a case with what it holds: the case, the lock of its folder.
class Run {
public:
  /// Begins in the folder of the options. Throws InputError and IoError.
  Run(input::Case input, RunOptions options, RunObserver& observer);
  /// Goes on with the run in the folder, from its newest good checkpoint, from step 0 without one; ends as
  /// the uninterrupted run would have, to the bit. Throws InputError when the folder holds no run, one that
  /// has finished, or only checkpoints of another case, and IoError.
  Run(RunOptions options, RunObserver& observer);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// As Session; a run that has ended leaves its folder to others.
  std::optional<Exit> go_on();
  Session& session() { return *session_; }
  const input::Case& input() const { return input_; }
  const RunOptions& options() const { return options_; }

private:
  template<int dim> void begin(RunObserver& observer);
  template<int dim> void resume(RunObserver& observer);
  template<class Make> auto take_up(RunObserver& observer, Make&& make) -> decltype(make(true));

  RunOptions options_;
  std::optional<results::FolderLock> lock_;
  input::Case input_;
  std::unique_ptr<Session> session_;
};

/// Whether the run in the folder has reached its end; its report is made where it is missing. Throws
/// InputError when the folder holds no run, and IoError.
bool has_finished(const std::filesystem::path& folder);

/// Runs the case into the folder and writes its report. Returns done, diverged (with the post-mortem in
/// status.json and the report), interrupted (a signal stopped it at a checkpoint) or io_failed (writing
/// failed on the way; checkpoints are whole). Throws InputError and IoError.
Exit run(const input::Case& input, const RunOptions& options, RunObserver& observer);
Exit run(const input::Case& input, const RunOptions& options); ///< silently

/// Goes on with the run in options.output from its newest good checkpoint, from step 0 without one, and ends
/// as the uninterrupted run would have, to the bit. Returns as run() does; done at once for a run that has
/// finished. Throws InputError when the folder holds no run or only checkpoints of another case, and IoError.
Exit restart(const RunOptions& options, RunObserver& observer);

/// What there is to know of a case before it runs.
struct Checked {
  std::vector<std::string> warnings;
  /// {label, text}: nodes, first step and what limits it, steps to come, memory, tool overlap; a text goes on
  /// under an empty label.
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::pair<std::string, double>> numbers; ///< SI, those that programs ask for
  std::string fault;                                   ///< why it cannot run; empty when it can
};

/// The variables of a case as a check tells them, {name, text}.
std::vector<std::pair<std::string, std::string>> variable_texts(const input::Case& input);

/// Writes the fields of a state into output/initial. Returns the path of their list. Throws IoError.
template<int dim>
std::string write_initial_fields(const input::Case& input, const RunOptions& options,
                                 const results::Snapshot<dim>& shot);

/// Builds geometry and model without running; writes the initial fields to output/initial, where there is an
/// output. Throws InputError and IoError.
Checked check(const input::Case& input, const RunOptions& options);

} // namespace cnem::app
