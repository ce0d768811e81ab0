#pragma once
// An explicit run from its set-up to its report: the time loop in a fixed order, output, checkpoint, adapt,
// step.
#include "app/divergence.hpp"
#include "app/plane_features.hpp"
#include "app/retries.hpp"
#include "app/run.hpp"
#include "app/space_features.hpp"
#include "app/stopwatch.hpp"
#include "app/time_control.hpp"
#include "app/watches/mass_balance.hpp"
#include "app/watches/measured_range.hpp"
#include "app/watches/melting.hpp"
#include "app/watches/penetration.hpp"
#include "results/checkpoint.hpp"
#include "results/file_queue.hpp"
#include "results/recorder.hpp"
#include "results/sample_lines.hpp"
#include "results/status.hpp"

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cnem::app {

/// In the plane (dim 2) and in space (3).
template<int dim> class Simulation final : public Session {
public:
  /// Builds the solver at time 0. `input` and `observer` must outlive this object. Throws InputError.
  Simulation(const input::Case& input, const RunOptions& options, RunObserver& observer);

  /// Throws InputError when a tool is too fast for the first step: at the start of a new run.
  void check_tools();
  /// Begins the files of a new run. Throws IoError.
  void start();
  /// Takes the state of a checkpoint and goes on with the files that are there: what is later than the
  /// checkpoint is dropped. Throws IoError with the reason when the checkpoint does not fit them or the case;
  /// then this object is of no more use.
  void resume(results::CheckpointReader& checkpoint);
  /// To be told in the status.
  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }

  std::optional<Exit> go_on() override;
  results::RunStatus status() override;
  std::variant<results::Snapshot<2>, results::Snapshot<3>> snapshot() override {
    return features_.snapshot(solver_);
  }
  const results::HistoryLog& history() const override { return history_.log(); }

private:
  /// What a checkpoint keeps: the course, what is remembered to go back to, and wall times.
  int archive(Archive& archive, int frames);
  /// What evolves, and the `frames` of fields.pvd until then. Both return what they carried of these.
  int archive_course(Archive& archive, int frames);
  /// Goes on with the files behind the present state, of which fields.pvd has `frames` frames.
  void take_up_files(int frames);
  /// Runs until it ends, pauses or fails.
  std::optional<DivergenceError> run_on();
  void loop();
  results::ProgressState progress() const;
  /// The last output, status and report.
  void end();
  /// Back to the last pass, to renew the reference sooner from there; false when the failure is final.
  bool go_back(const DivergenceError& error);
  bool finished();
  void record_due();
  void record_last();
  void judge_energy() const;
  /// Whether no step follows.
  bool at_end() const;
  void unload();
  void record(bool history, bool fields, bool pictures);
  void adapt_and_step();
  /// Whether there is a new one.
  bool new_reference();
  void follow(const Resampling<dim>& change);
  void look_at_step();
  /// At what is to be told and leaves the results alone.
  void look_around();
  void refresh_step();
  /// Of the frames written until now.
  int frames() const { return fields_ ? fields_->frames() : 0; }
  void write_checkpoint(int frames);
  void stop(Exit exit, std::string reason);
  void diverge(const DivergenceError& error);
  Exit fail(const std::string& message);
  std::string how_to_go_on() const;
  /// Those that come up on the way.
  std::vector<std::string> late_warnings() const;
  void add_step_times(Stopwatch& watch) const;
  std::vector<std::pair<std::string, double>> wall() const;

  const input::Case& input_;
  RunOptions options_;
  RunObserver& observer_;
  enum class Stage { begun, under_way, paused, ended };
  Stage stage_ = Stage::begun;
  Stopwatch watch_;
  std::vector<std::string> warnings_;
  ExplicitSolver<dim> solver_;
  results::HistoryRecorder<dim> history_;
  results::SampleLines<dim> lines_;
  results::FileQueue files_;                     ///< frames and pictures on their way to the disk
  std::optional<results::FieldRecorder> fields_; ///< of a run with a folder, once it has begun
  Schedule history_due_, fields_due_, pictures_due_;
  StepControl control_;
  ReferenceRenewal renewal_;
  Retries retries_;
  MeltingWatch melting_;
  MassBalanceWatch mass_balance_;
  PenetrationWatch penetration_;
  MeasuredRangeWatch measured_range_;
  std::conditional_t<dim == 2, PlaneFeatures, SpaceFeatures> features_;
  CheckpointTimer checkpoints_;
  std::int64_t last_check_ = -1; ///< step of the last look at the stable step; −1: none yet
  double node_steps_ = 0.0;
  std::string last_checkpoint_; ///< of which step and time it is, in words
  Exit exit_ = Exit::done;
  std::string reason_;
  std::optional<results::PostMortem> dead_;
};

/// Builds the solver of a case. Throws InputError.
template<int dim>
ExplicitSolver<dim> make_solver(const input::Case& input, std::vector<std::string>& warnings);

/// A cell over which a mode of failure would let go more energy than it takes cannot spend it: throws
/// InputError.
template<int dim> void refuse_snap_back(const input::Case& input, const ExplicitSolver<dim>& solver);

extern template class Simulation<2>;
extern template class Simulation<3>;

} // namespace cnem::app
