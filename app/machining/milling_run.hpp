#pragma once
// One milling cut in the time domain: forces, vibrations, and the surface that is left.
#include "app/machining/machined_surface.hpp"
#include "app/machining/machining_session.hpp"
#include "app/time_control.hpp"
#include "machining/cut_vibration.hpp"
#include "machining/milling_process.hpp"
#include "results/checkpoint.hpp"

namespace cnem::app {

/// Writes history.csv (a row a step), surface.csv and surface.vtk (what is left on the machined side along
/// the path) with a picture, spectra.csv, status.json and the report.
class MillingRun final : public MachiningSession {
public:
  MillingRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
             bool goes_on = false);

  /// Takes the state of a checkpoint and goes on behind the rows that were there. Throws IoError with the
  /// reason when it does not fit the case or the files.
  void resume(results::CheckpointReader& checkpoint);
  /// A warning beside those of the case.
  void warn(std::string warning) { status_.warnings.push_back(std::move(warning)); }

private:
  /// The largest and the mean of a part of the run.
  struct Course {
    Vec3 force = Vec3::Zero();     ///< N, largest of each component
    double torque = 0.0;           ///< N m
    double work = 0.0, time = 0.0; ///< J, s
    double removed = 0.0;          ///< m³
    double thickest = 0.0;         ///< m
    double displacement = 0.0;     ///< m, largest
    void add(const machining::ProcessStep& step, double dt);
    void archive(Archive& archive);
  };
  bool solve() override;
  void write_files() override;
  void judge();
  /// One step; where it fails a checkpoint of the state before it is left.
  machining::ProcessStep advance();
  /// Those that are not of a part that deforms.
  std::vector<machining::Mode> modes_of_process() const;
  /// Growth of disturbances, spectra and frequency of chatter; whether disturbances grow.
  bool judge_vibration();
  struct Window {
    double from = 0.0, to = 0.0; ///< steps
    bool holds(double at) const { return at > from && at < to; }
  };
  /// Whole turns that stand for the cut: the last ones, a share of all, up to where the feed ends; of passes,
  /// which enter and leave, those in the middle half of the last one. most: turns.
  Window steady_turns(double share, double most) const;
  void write_checkpoint();
  std::filesystem::path history_file() const; ///< empty where there is no folder
  void archive(Archive& archive);

  machining::MillingProcess process_;
  CheckpointTimer checkpoints_;
  Course steady_;                ///< of the last turns
  double first_frequency_ = 0.0; ///< Hz, of a part that deforms, at first

  machining::CutVibration vibration_; ///< of the turns that stand for the cut
  std::optional<MachinedSurface> surface_;
};

} // namespace cnem::app
