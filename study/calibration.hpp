#pragma once
// Constants that bring computed curves to measured ones: cnem calibrate. The format of the file is described
// in docs/experiments.md.
#include "evaluate/experiment.hpp"
#include "evaluate/material_point.hpp"
#include "input/case.hpp"
#include "input/schema/document.hpp"
#include "input/schema/units.hpp"
#include "study/batch.hpp"

#include <Eigen/Dense>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::study {

/// A constant that is looked for: a key of the cases, between bounds.
struct SoughtConstant {
  std::string name, key;
  input::Location where;
  double low = 0.0, high = 1.0, start = 0.5; ///< SI
  bool logarithmic = false;
  input::Unit unit{};             ///< in which it was written
  std::string unit_text, si_unit; ///< "" for numbers

  /// Its place between the bounds, 0 to 1, and the value (SI) at a place.
  double place_of(double value) const;
  double at(double place) const;
  /// As a user would write it, and in SI for the key of a case.
  std::string text(double value, int digits = 6) const;
  input::Override change(double value) const;
};

/// A measured curve of a test of the material alone.
struct PointTarget {
  std::string material; ///< of the case
  evaluate::PointTest test;
  evaluate::ComparedCurve measured; ///< strain, Pa
};

/// A measured number of an orthogonal cut.
struct MeasuredNumber {
  enum class What { Fc, Ft, chip_thickness };
  What what = What::Fc;
  double value = 0.0;      ///< N or N/m; m
  bool per_width = false;  ///< N/m
  double error = 0.0;      ///< standard error, in the same unit
  bool error_known = true; ///< else it is a share of the value
  const char* name() const;
};

/// What was measured of the steady part of a cut, beside what the case says of it.
struct CutTarget {
  std::vector<MeasuredNumber> measured;
  bool closed_form = false; ///< the shear zone of evaluate/shear_zone.hpp stands for the run
};

/// What curves are compared with: all of [report.experiment] of a case, one of a single point, or a cut.
struct CalibrationTarget {
  std::string name;
  input::Location where;
  std::filesystem::path case_file;
  std::vector<input::Override> set;
  double weight = 1.0;              ///< 0: it is left out of the search, and compared in the end
  std::optional<PointTarget> point; ///< none: the case is run
  std::optional<CutTarget> cut;     ///< its cut is compared, in place of curves

  bool runs() const { return !point && !(cut && cut->closed_form); }
  bool fitted() const { return weight > 0.0; }
};

struct Calibration {
  std::string name, title;
  std::vector<SoughtConstant> constants;
  std::vector<CalibrationTarget> targets;
  int evaluations = 60; ///< of the misfit, by all starts together
  int starts = 1;
  double tolerance = 1e-4; ///< of the places of constants between their bounds
  int processes = 0, threads = 1;
  std::vector<std::string> warnings; ///< of its curves and cases

  std::vector<input::Override> changes(const CalibrationTarget& target, const Eigen::VectorXd& place) const;
};

/// Reads the file of a calibration. Throws InputError "file:line:column: key '…': …" for whatever is wrong in
/// it, with the cases at the start, IoError when it cannot be read.
Calibration read_calibration(const std::filesystem::path& path);

/// A measured curve and the one that was computed for it.
struct CalibratedCurve {
  std::string name;
  std::size_t target = 0;
  bool over_stroke = true, of_point = false;
  std::string x_unit, y_unit;                 ///< SI
  evaluate::ComparedCurve measured, computed; ///< measured: as far as the computed one goes
  double peak = 0.0;                          ///< of the whole measured curve
  std::string note;                           ///< what makes the comparison doubtful; empty otherwise
  double relative_error = 0.0;                ///< of a number of a cut, as a share of its peak
  double weight = 1.0;    ///< beside that of its target: of a number of a cut, by its error
  double rms_share = 0.0; ///< – root mean square of the difference over the measured peak
  bool fitted = true;     ///< false: of a target that is left out of the search

  bool single_number() const { return measured.x.size() < 2; } ///< of a cut
};

/// What constants have come to.
struct Evaluation {
  Eigen::VectorXd place;
  std::string failure;                 ///< empty: it went well
  std::vector<CalibratedCurve> curves; ///< behind them those that are left out, once they are compared
  std::vector<std::size_t> lengths{};  ///< residuals of each curve that is fitted
  std::vector<std::string> left_out_failures{}; ///< of targets that are left out
  Eigen::VectorXd residual;                     ///< weighted, so that its squares add up to the misfit
  double misfit = 0.0;         ///< – mean of the squared rms shares of all curves by weight
  double known_variance = 0.0; ///< of each residual, by the errors of numbers; 0: not known

  bool good() const { return failure.empty(); }
  /// Of that name; nullptr without one.
  const CalibratedCurve* curve(const std::string& name) const;
  /// Root mean square of the rms shares of the curves that are left out; none without one.
  std::optional<double> left_out_misfit() const;
};

/// The misfit of constants with which a run fails: twice the measured peak everywhere.
inline constexpr double failed_misfit = 4.0;

struct VisitedPlace {
  Eigen::VectorXd place;
  double misfit = 0.0;
  bool good = true; ///< false: its evaluation failed

  /// The lesser misfit; whatever went well before what failed.
  bool better_than(const VisitedPlace& other) const {
    return good != other.good ? good : misfit < other.misfit;
  }
};

/// What a search found.
struct SearchEnd {
  std::vector<VisitedPlace> course; ///< in the order of its evaluations
  std::size_t best = 0;
  std::string reason; ///< why it stopped
};

/// What the curves say of the constants (docs/experiments.md).
struct Inference {
  Eigen::MatrixXd jacobian;       ///< residual by place
  Eigen::VectorXd singular;       ///< falling
  Eigen::MatrixXd directions;     ///< [constant][direction] unit vectors
  Eigen::MatrixXd covariance;     ///< of places; of the directions that are told
  std::vector<bool> weak;         ///< [direction] the curves do not tell it
  std::vector<bool> told;         ///< [constant]
  Eigen::VectorXd half_width;     ///< of the 95% interval, of places
  double independent = 0.0;       ///< number of residuals that are
  double degrees = 0.0;           ///< of freedom
  double quantile = 0.0;          ///< of 95%, by Student's t; 0: there are no intervals
  std::vector<std::string> words; ///< what the curves do not tell

  bool intervals() const { return quantile > 0.0; }
};

/// 97.5% quantile of Student's t: half the width of a 95% interval. degrees: of freedom, above 0.
double student_quantile(double degrees);

/// residual at the best place; jacobian by finite differences there, with columns that are not finite for
/// constants whose sensitivity is not known. curve_lengths: residuals of each curve. With errors of the
/// numbers that are compared (Evaluation::known_variance) the variance is theirs, or that of the residuals if
/// it is larger.
Inference infer(const Calibration& calibration, const Eigen::VectorXd& residual, Eigen::MatrixXd jacobian,
                const std::vector<std::size_t>& curve_lengths, double known_variance = 0.0);

/// Singular values, falling, of ∂ln y/∂ln p over the constants whose sensitivity is known: residuals are
/// shares of y by weight, times 1/√N.
Eigen::VectorXd logarithmic_values(const Calibration& calibration, const Eigen::VectorXd& place,
                                   const Eigen::MatrixXd& jacobian);

/// Everything that tables and pages show.
struct CalibrationResult {
  Evaluation start, best;
  std::vector<SearchEnd> searches;
  Inference inference;
  Eigen::VectorXd logarithmic;               ///< singular values of ∂ln(curves)/∂ln(constants)
  std::size_t evaluations = 0, failures = 0; ///< of different constants
};

/// What is to be told of its curves and cases, and of what was found.
std::vector<std::string> warnings_of(const Calibration& calibration, const CalibrationResult& result);

/// Flow stress over strain at a rate and a temperature that the targets meet, with the band of the
/// covariance.
struct FlowBand {
  std::string name;
  double rate = 0.0, temperature = 0.0;           ///< 1/s, K
  std::vector<double> strain, stress, half_width; ///< –, Pa; no widths without intervals
};
std::vector<FlowBand> flow_bands(const Calibration& calibration, const CalibrationResult& result,
                                 const std::filesystem::path& folder);

/// calibrated.toml, calibration.json, calibration.csv, report.html.
struct CalibrationFiles {
  std::string constants, json, table, report;
};
CalibrationFiles calibration_files(const Calibration& calibration, const CalibrationResult& result,
                                   const std::vector<FlowBand>& bands, const std::string& version);

/// Searches, and writes what was found. Runs that the folder holds already are not run again, so that a
/// calibration that was killed goes on with the same sequence. Returns done; diverged when no evaluation went
/// well; interrupted after SIGINT, SIGTERM or SIGHUP. Throws InputError; IoError also when a run ends for
/// reasons that are none of its constants (a full disk, a signal).
Exit calibrate(const Calibration& calibration, const BatchOptions& options);

} // namespace cnem::study
