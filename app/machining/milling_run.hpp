#pragma once
// One milling cut in the time domain: forces, vibrations, and the surface that is left.
#include "app/machining/machining_session.hpp"
#include "machining/milling_process.hpp"

namespace cnem::app {

/// Writes history.csv (a row a step), surface.csv (what is left on the machined side along the path),
/// status.json and the report.
class MillingRun final : public MachiningSession {
public:
  using MachiningSession::MachiningSession;

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
  };
  void solve() override;
  void write_files() override;
  void judge(const Course& steady);
  void measure_surface(const machining::MillingProcess& process);

  std::vector<double> place_;             ///< m along the path
  std::vector<double> height_;            ///< m of each layer
  std::vector<std::vector<double>> left_; ///< [layer][place] m
};

} // namespace cnem::app
