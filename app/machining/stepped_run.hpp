#pragma once
// What analyses of machining that go step by step share: rows of a history, checkpoints, interruptions.
#include "app/machining/machining_session.hpp"
#include "app/time_control.hpp"
#include "results/checkpoint.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cnem::app {

class SteppedRun : public MachiningSession {
public:
  /// Takes the state of a checkpoint and goes on behind the rows that were there. Throws IoError with the
  /// reason when it does not fit the case or the files.
  void resume(results::CheckpointReader& checkpoint);
  /// A warning beside those of the case.
  void warn(std::string warning) { status_.warnings.push_back(std::move(warning)); }

protected:
  /// columns: of history.csv, a row a step.
  SteppedRun(const input::Case& input, const RunOptions& options, RunObserver& observer, bool goes_on,
             std::vector<std::string> columns);

  bool solve() final;
  /// Into the folder, where there is one.
  void write_checkpoint();

  virtual bool at_end() const = 0;
  virtual std::int64_t steps() const = 0; ///< that are done
  virtual double time() const = 0;        ///< s, reached
  virtual double end() const = 0;         ///< s
  virtual double dt() const = 0;          ///< s, of the next step
  /// Goes to where a checkpoint may lie next, and writes the rows of the steps.
  virtual void advance() = 0;
  /// What evolves.
  virtual void archive(Archive& archive) = 0;
  /// Tells in the status what came of it, at the end.
  virtual void judge() = 0;

private:
  std::filesystem::path history_file() const; ///< empty where there is no folder

  std::vector<std::string> columns_;
  CheckpointTimer checkpoints_;
};

} // namespace cnem::app
