#pragma once
// What a run leaves behind: rows of history, fields, pictures.
#include "app/snapshot.hpp"
#include "io/case.hpp"
#include "io/history_writer.hpp"
#include "io/picture.hpp"
#include "io/picture_album.hpp"
#include "io/vtk_writer.hpp"
#include "mechanics/explicit_solver.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// A material point as a weighted mean of nodes: natural-neighbour weights of its initial position.
struct ProbeWeights {
  std::string name;
  std::vector<std::string> fields;
  std::vector<std::int32_t> node;
  std::vector<double> weight;
};

/// Units in the headers of histories: per metre of thickness, or of the whole body of revolution.
struct HistoryUnits {
  std::string force = "[N/m]", energy = "[J/m]", mass = "[kg/m]";
};
HistoryUnits history_units(const io::Case& input);

/// Names and values of history.csv.
class HistoryRecorder {
public:
  /// Throws InputError for probes outside the domain.
  HistoryRecorder(const io::Case& input, const ExplicitSolver<2>& solver,
                  const std::filesystem::path& folder);

  void record(const ExplicitSolver<2>& solver);
  /// Probes stay where they are in the matter of a changed cloud.
  void resample(const Resampling<2>& change, const ExplicitSolver<2>& solver);

  /// What a checkpoint keeps of it.
  void archive(Archive& archive);
  /// Goes on with the history that is there: rows later than the checkpoint are dropped. Throws IoError when
  /// earlier ones are missing.
  void resume(const ExplicitSolver<2>& solver);

  /// Largest |residual| seen over the largest (external work + initial energy) seen.
  double energy_residual() const;
  double last_residual() const { return last_residual_; } ///< J/m, J of revolution
  /// Kinetic energy over that of deformation, both averaged over the run so far; 0 while nothing deforms.
  double kinetic_share() const { return deformation_ > 0.0 ? kinetic_ / deformation_ : 0.0; }
  /// Why the inertia of a scaled run is not small; empty when it is, or nothing is scaled.
  std::string kinetic_warning(const io::Case& input) const;
  double energy_scale() const { return scale_; } ///< J/m
  /// Named results for status.json.
  std::vector<std::pair<std::string, double>> metrics() const { return metrics_; }

private:
  std::vector<std::pair<std::string, double>> row(const ExplicitSolver<2>& solver) const;
  void keep_metric(const std::string& name, double value, bool largest);

  HistoryUnits units_;
  std::vector<ProbeWeights> probes_;
  std::vector<io::HistoryWriter> writer_; ///< one; made with the first row, when the columns are known
  std::filesystem::path folder_;
  double initial_area_ = 0.0, initial_mass_ = 0.0;
  std::int64_t rows_ = 0;
  double worst_residual_ = 0.0, last_residual_ = 0.0, scale_ = 0.0;
  double last_time_ = 0.0;                   ///< s, of the last row
  double kinetic_ = 0.0, deformation_ = 0.0; ///< J s/m, their time integrals
  std::vector<std::pair<std::string, double>> metrics_;
};

/// Writes lines/NAME.csv for every line of the case: distance and initial position, then the fields, from
/// natural-neighbour interpolation of nodal values.
void write_lines(const io::Case& input, const Snapshot& shot, const std::filesystem::path& folder);

/// Writes fields.pvd frames with every field of the catalogue, through a queue that must outlive the frames.
class FieldRecorder {
public:
  explicit FieldRecorder(const std::filesystem::path& folder) : writer_(folder) {}
  /// Goes on with the series that is there: frames later than `time` (s) are dropped. Throws IoError.
  FieldRecorder(const std::filesystem::path& folder, double time)
      : writer_(io::FieldWriter::resume(folder, time)) {}
  void record(io::FileQueue& files, const Snapshot& shot);
  int frames() const { return writer_.frames(); }

private:
  io::FieldWriter writer_;
};

} // namespace cnem::app
