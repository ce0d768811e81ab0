#pragma once
// One milling cut in the time domain: forces, vibrations, and the surface that is left.
#include "app/machining/machined_surface.hpp"
#include "app/machining/pass_records.hpp"
#include "app/machining/stepped_run.hpp"
#include "machining/cut_vibration.hpp"
#include "machining/milling_process.hpp"

namespace cnem::app {

/// Writes history.csv (a row a step), surface.csv and surface.vtk (what is left on the machined side along
/// the path) with a picture, spectra.csv, status.json and the report.
class MillingRun final : public SteppedRun {
public:
  MillingRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
             bool goes_on = false);

private:
  MillingRun(const input::Case& input, const RunOptions& options, RunObserver& observer, bool goes_on,
             const machining::ProcessSettings& settings);
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
  struct Window {
    double from = 0.0, to = 0.0; ///< steps
    bool holds(double at) const { return at > from && at < to; }
  };
  bool at_end() const override { return process_.at_end(); }
  std::int64_t steps() const override { return process_.steps(); }
  double time() const override { return process_.time(); }
  double end() const override { return process_.motion().duration(); }
  double dt() const override { return process_.motion().dt(process_.steps()); }
  void advance() override;
  void archive(Archive& archive) override;
  void judge() override;
  void write_files() override;
  /// One step; where it fails a checkpoint of the state before it is left.
  machining::ProcessStep made_step();
  /// Those that are not of a part that deforms.
  std::vector<machining::Mode> modes_of_process() const;
  /// What becomes of disturbances: they die out where they shrink, do not grow anew, and are lost beside what
  /// the teeth force.
  enum class Disturbances { unknown, grow, last, die_out };
  /// Tells their growth, and the frequency of the teeth.
  Disturbances judge_vibration(const std::optional<machining::CutVibration::Growth>& growth);
  /// Whole turns that stand for the cut: the last ones, a share of all, up to where the feed ends; of passes,
  /// which enter and leave, those in the middle half of the last one. most: turns.
  Window steady_turns(double share, double most) const;
  /// m, the thickest chip of a cut without vibration in the turns that stand for forces; of passes, whose
  /// engagement is that of what those before have left, and where the drive changes, by a rigid run of the
  /// last one from its first step on. 0: nothing vibrates there.
  double still_chips() const;

  machining::MillingProcess process_;
  Window counts_, heard_; ///< turns that stand for forces, and for vibration
  Course steady_;         ///< of the last turns
  PassRecords passes_;
  double still_ = 0.0;           ///< m, still_chips(); 0 before they are known
  double first_frequency_ = 0.0; ///< Hz, of a part that deforms, at first

  machining::CutVibration vibration_; ///< of the turns that stand for the cut
  std::int64_t unsettled_steps_ = 0;  ///< in which forces and vibration did not quite agree
  double unsettled_ = 0.0;            ///< m, by how much at most
  std::optional<MachinedSurface> surface_;
};

} // namespace cnem::app
