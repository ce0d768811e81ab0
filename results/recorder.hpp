#pragma once
// What a run leaves behind: rows of history, fields, pictures.
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "results/history_log.hpp"
#include "results/history_units.hpp"
#include "results/point_weights.hpp"
#include "results/snapshot.hpp"
#include "results/vtk_writer.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::results {

/// A material point whose fields are recorded.
struct ProbeWeights : PointWeights {
  std::string name;
  std::vector<std::string> fields;
};

/// Of a run in which nothing moves: what is missing in the balance of heat over the heat that has moved, the
/// larger of Σ C |T − T₀| over the nodes and of what went through the boundary; 0 where none has.
template<int dim> double heat_residual_share(const ExplicitSolver<dim>& solver);

/// Names and values of history.csv.
template<int dim> class HistoryRecorder {
public:
  /// folder: of history.csv; empty: rows stay in memory, as they do beside the file with `keep`. Throws
  /// InputError for probes outside the domain.
  HistoryRecorder(const input::Case& input, const ExplicitSolver<dim>& solver,
                  const std::filesystem::path& folder, bool keep = false);

  void record(const ExplicitSolver<dim>& solver);
  /// Probes stay where they are in the matter of a changed cloud.
  void resample(const Resampling<dim>& change, const ExplicitSolver<dim>& solver);

  /// What a checkpoint keeps of it.
  void archive(Archive& archive);
  const HistoryLog& log() const { return log_; }
  /// Goes on with the history that is there: rows later than the checkpoint are dropped. Throws IoError when
  /// earlier ones are missing.
  void resume(const ExplicitSolver<dim>& solver);

  /// Largest |residual| seen over energy_scale().
  double energy_residual() const;
  double last_residual() const { return last_residual_; } ///< J/m, J of revolution
  /// Kinetic energy over that of deformation, both averaged over the run so far; 0 while nothing deforms.
  double kinetic_share() const { return deformation_ > 0.0 ? kinetic_ / deformation_ : 0.0; }
  /// Why the inertia of a scaled run is not small; empty when it is, or nothing is scaled.
  std::string kinetic_warning(const input::Case& input) const;
  /// What residuals are compared with, J/m, J of revolution: the largest (external work + initial energy)
  /// seen. Where nothing has done work: what expands takes its energy from heat, and a body at rest has the
  /// rounding of its forces, no more than if it moved at 1e-7 m/s.
  EnergyScale energy_scale() const;
  /// Named results for status.json.
  std::vector<std::pair<std::string, double>> metrics() const { return metrics_; }

private:
  /// Everything that is told of the present state, declared where it is computed.
  std::vector<Metric> row(const ExplicitSolver<dim>& solver) const;
  void keep(const Metric& metric);

  HistoryUnits units_;
  std::vector<ProbeWeights> probes_;
  HistoryLog log_; ///< begins with the first row, when the columns are known
  std::filesystem::path folder_;
  double initial_measure_ = 0.0, initial_mass_ = 0.0;
  std::int64_t rows_ = 0;
  double worst_residual_ = 0.0, last_residual_ = 0.0, scale_ = 0.0;
  double heat_ = 0.0;      ///< J/m, largest heat taken up or given off by a body that expands
  double last_time_ = 0.0; ///< s, of the last row
  double kinetic_ = 0.0, deformation_ = 0.0; ///< J s/m, their time integrals
  std::vector<std::pair<std::string, double>> metrics_;
};

/// Writes fields.pvd frames with every field of the catalogue and the tools, and tools.pvd with the fields of
/// tools that conduct, through a queue that must outlive the frames.
class FieldRecorder {
public:
  /// `input` must outlive this object.
  FieldRecorder(const std::filesystem::path& folder, const input::Case& input)
      : writer_(folder), folder_(folder), input_(&input) {}
  /// Goes on with the series that is there: frames later than `time` (s) are dropped. Throws IoError.
  FieldRecorder(const std::filesystem::path& folder, const input::Case& input, double time);
  /// Does nothing where the last frame is of the same time.
  template<int dim> void record(FileQueue& files, const Snapshot<dim>& shot);
  int frames() const { return writer_.frames(); }

private:
  FieldWriter writer_;
  std::optional<FieldWriter> tools_; ///< begins with the first frame of tools that conduct
  std::filesystem::path folder_;
  const input::Case* input_;
};

} // namespace cnem::results
