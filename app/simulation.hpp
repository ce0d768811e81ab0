#pragma once
// An explicit run from its set-up to its report: the time loop in a fixed order, output, checkpoint, adapt,
// step.
#include "app/adaptation.hpp"
#include "app/divergence.hpp"
#include "app/picture_recorder.hpp"
#include "app/recorder.hpp"
#include "app/run.hpp"
#include "app/stopwatch.hpp"
#include "app/time_control.hpp"
#include "io/blanking.hpp"
#include "io/checkpoint.hpp"
#include "io/file_queue.hpp"
#include "io/progress.hpp"
#include "io/status.hpp"
#include "mechanics/springback.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// When checkpoints are due by steps, simulated time and wall clock.
class CheckpointTimer {
public:
  explicit CheckpointTimer(const io::CheckpointControl& control) : control_(&control) {}
  bool due(const State<2>& state) const;
  /// A checkpoint of this state is there.
  void written(const State<2>& state);

private:
  const io::CheckpointControl* control_;
  std::int64_t step_ = -1; ///< of the last one; −1: none yet
  double next_time_ = 0.0; ///< s
  double wall_ = 0.0;      ///< s, wall_time() of the last one
};

class Simulation {
public:
  /// Builds the solver at time 0. `input` must outlive this object. Throws InputError.
  Simulation(const io::Case& input, const RunOptions& options);

  /// Begins the files of a new run. Throws IoError.
  void start();
  /// Takes the state of a checkpoint and goes on with the files that are there: what is later than the
  /// checkpoint is dropped. Throws IoError with the reason when the checkpoint does not fit them or the case;
  /// then this object is of no more use.
  void resume(io::CheckpointReader& checkpoint);
  /// To be told in the status.
  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }

  /// Runs to the end, or until it diverges, writing fails or a signal (app/run_signals.hpp) stops it; writes
  /// status and report.
  Exit run();

private:
  void archive(Archive& archive);
  void loop();
  bool finished();
  void record_due();
  void record_last();
  /// Whether no step follows.
  bool at_end() const;
  void let_go();
  void evaluate();
  /// Good until the next one.
  Snapshot shot();
  void record(bool history, bool fields, bool pictures);
  void adapt_and_step();
  void new_reference();
  void look_at_step();
  void write_checkpoint();
  void stop(Exit exit, std::string reason);
  void diverge(const DivergenceError& error);
  Exit fail(const std::string& message);
  io::RunStatus status();
  std::vector<std::pair<std::string, double>> wall() const;

  const io::Case& input_;
  RunOptions options_;
  Stopwatch watch_;
  std::vector<std::string> warnings_;
  ExplicitSolver<2> solver_;
  HistoryRecorder history_;
  io::FileQueue files_; ///< frames and pictures on their way to the disk
  std::optional<FieldRecorder> fields_;
  std::optional<PictureRecorder> pictures_;
  Schedule history_due_, fields_due_, pictures_due_;
  StepControl control_;
  ReferenceRenewal renewal_;
  Adaptation adaptation_;
  AdaptationFields adaptation_fields_;
  std::optional<Springback> springback_;       ///< of the state at the end
  std::optional<io::BlankingResult> blanking_; ///< where the case asks for it and the run has ended well
  CheckpointTimer checkpoints_;
  io::Progress progress_;
  std::int64_t last_check_ = -1; ///< step of the last look at the stable step; −1: none yet
  double node_steps_ = 0.0;
  std::string last_checkpoint_; ///< of which step and time it is, in words
  Exit exit_ = Exit::done;
  std::string reason_;
  std::optional<io::PostMortem> dead_;
};

/// Builds the solver of a case. Throws InputError.
ExplicitSolver<2> make_solver(const io::Case& input, std::vector<std::string>& warnings);

} // namespace cnem::app
