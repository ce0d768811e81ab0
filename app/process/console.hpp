#pragma once
// A run on the command line: prints what it tells and minds signals.
#include "app/observer.hpp"
#include "app/process/run_signals.hpp"

#include <optional>
#include <string>

namespace cnem::app {

/// Messages and progress go to standard error, outcomes to standard output. Signals ask a run in
/// steps to stop at a checkpoint, or for a checkpoint.
class Console final : public RunObserver {
public:
  void begins() override { signals_.emplace(); }
  void remark(const std::string& text) override { progress_.message(text); }
  void outcome(const std::string& text) override;
  void failure(const std::string& text) override;
  void progress(const results::ProgressState& state) override { progress_.update(state); }
  void steps_end() override { progress_.finish(); }
  Request request() override;
  bool owns_process() const override { return true; }

private:
  std::optional<RunSignals> signals_;
  results::Progress progress_;
};

} // namespace cnem::app
