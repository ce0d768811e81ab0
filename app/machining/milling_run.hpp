#pragma once
// One milling cut in the time domain: forces, vibrations, and the surface that is left.
#include "app/machining/machining_session.hpp"
#include "app/time_control.hpp"
#include "machining/milling_process.hpp"
#include "results/checkpoint.hpp"

namespace cnem::app {

/// Writes history.csv (a row a step), surface.csv (what is left on the machined side along the path),
/// status.json and the report.
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
  void measure_surface();
  /// m, as the process has it. Throws DivergenceError where no matter is left.
  double left_at(std::size_t layer, double x) const;
  /// The machined side of one layer along the path, m.
  struct Texture {
    double Ra = 0.0, Rz = 0.0, peak_to_valley = 0.0, location_error = 0.0;
  };
  Texture texture(std::size_t layer) const;
  /// Metrics of the surface, and of thirds of the height: means of Ra and Rz, the largest of the others.
  void tell_surface();
  void write_checkpoint();
  std::filesystem::path history_file() const; ///< empty where there is no folder
  void archive(Archive& archive);

  machining::MillingProcess process_;
  CheckpointTimer checkpoints_;
  Course steady_;                ///< of the last turns
  double first_frequency_ = 0.0; ///< Hz, of a part that deforms, at first

  std::string surface_ = "the path is too short for a surface";
  std::vector<double> place_;             ///< m along the path
  std::vector<std::size_t> cut_layer_;    ///< those that the cutter reaches
  std::vector<std::vector<double>> left_; ///< [layer that is cut][place] m
};

} // namespace cnem::app
