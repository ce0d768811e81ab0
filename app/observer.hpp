#pragma once
// What a run tells while it goes on, and what it is asked for. What becomes of that is the business of
// whoever starts it: the command line prints and minds signals (app/process/console.hpp); a program that the
// run is a part of looks at its results in between.
#include "results/progress.hpp"

#include <string>

namespace cnem::app {

/// What is asked of a run before a step.
struct Request {
  enum class Kind {
    go_on,
    checkpoint, ///< write one and go on
    pause,      ///< return and be there to go on
    stop        ///< write a checkpoint and end
  };
  Kind kind = Kind::go_on;
  std::string by{}; ///< who asks to stop: "SIGTERM"
};

/// By itself: a silent run to its end.
class RunObserver {
public:
  virtual ~RunObserver() = default;

  /// A run in steps begins to set itself up: from here on it minds requests.
  virtual void begins() {}
  /// A message on the way: warnings, and what the run does about failures.
  virtual void remark(const std::string& /*text*/) {}
  /// A line about what came of the run.
  virtual void outcome(const std::string& /*text*/) {}
  /// Why the run cannot go on, and how it could.
  virtual void failure(const std::string& /*text*/) {}

  /// Before every step, and at the end.
  virtual void progress(const results::ProgressState& /*state*/) {}
  /// No step follows.
  virtual void steps_end() {}
  /// Output of the present time is made: a row of the history, a frame of the fields.
  virtual void recorded(bool /*row*/, bool /*frame*/) {}
  /// Before every step, once its output is made.
  virtual Request request() { return {}; }

  /// Whether what holds for the whole process, the instruction set, is the run's to choose.
  virtual bool owns_process() const { return false; }
};

} // namespace cnem::app
