#pragma once
// The misfit of constants: runs and single points, each done once.
#include "evaluate/shear_zone.hpp"
#include "study/calibration.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace cnem::study {

/// Evaluates places of constants between their bounds. Runs have folders that are named after their resolved
/// cases: what an earlier call has done is read, what it has begun goes on.
class Evaluator {
public:
  /// Both must outlive this object.
  Evaluator(const Calibration& calibration, const BatchOptions& options)
      : calibration_(calibration), options_(options) {}

  /// What is known of a place; nullptr before it is evaluated.
  const Evaluation* known(const Eigen::VectorXd& place) const;
  /// Evaluates all places, their runs in parallel. Returns false after SIGINT, SIGTERM or SIGHUP. Throws
  /// IoError.
  bool evaluate(const std::vector<Eigen::VectorXd>& places);
  /// Puts the curves of targets that are left out of the search behind the others, at those of the evaluated
  /// places that went well. To be called once. Returns as evaluate() does.
  bool compare_left_out(const std::vector<Eigen::VectorXd>& places);

  std::size_t count() const { return evaluations_.size(); }
  std::size_t failures() const;
  /// The folder of the run of a target.
  std::filesystem::path folder_of(const CalibrationTarget& target, const Eigen::VectorXd& place) const;

private:
  /// Runs of targets that are fitted, or of those that are left out. Returns as evaluate() does.
  bool run(const std::vector<Eigen::VectorXd>& places, bool fitted);
  std::string collect(std::size_t index, const Eigen::VectorXd& place, Evaluation& evaluation) const;
  std::string collect_run(const CalibrationTarget& target, std::size_t index, const Eigen::VectorXd& place,
                          Evaluation& evaluation) const;
  std::string collect_point(const CalibrationTarget& target, std::size_t index, const Eigen::VectorXd& place,
                            Evaluation& evaluation) const;
  std::string collect_cut(const CalibrationTarget& target, std::size_t index, const Eigen::VectorXd& place,
                          Evaluation& evaluation) const;
  Evaluation collected(const Eigen::VectorXd& place) const;

  const Calibration& calibration_;
  const BatchOptions& options_;
  std::map<std::string, Evaluation> evaluations_; ///< by place
  std::set<std::filesystem::path> ended_;         ///< folders of runs of this call that have ended
};

/// Why a run of an evaluation is to be counted as failed; empty where it is done.
std::string failure_of_run(const std::filesystem::path& folder);

/// The shear zone of a case with [cutting]; none where no angle fits.
std::optional<evaluate::ShearZone> closed_form_cut(const input::Case& input);

/// What a place is told apart by.
std::string place_key(const Eigen::VectorXd& place);

/// Residuals of curves, weighted, and the misfit: at the points of each measured curve, or at
/// `most_residuals` even places of one that has more. weights: of each curve.
void weigh(Evaluation& evaluation, const std::vector<double>& weights);

/// Numbers of cuts weigh by (e/ε)², ε their relative error and e the root mean square of all, so that they
/// weigh one in the mean; where every residual is such a number and each error is known, known_variance is
/// that of one residual.
void weigh_cuts(const Calibration& calibration, Evaluation& evaluation);

inline constexpr std::size_t most_residuals = 100; ///< of each curve

} // namespace cnem::study
