#pragma once
// A part that is not reduced to modes while it is milled, and loses what the tool takes: paper 004, Box 1.
#include "machining/flexible_part.hpp"
#include "machining/structure/removal.hpp"

#include <cstdint>
#include <memory>

namespace cnem::machining {

/// All unknowns of a part by Newmark's scheme with 1/4 and 1/2, under the mean force of each step: the
/// equilibrium at its end, (11), with 2 Q_mean − Q of its begin. While matter goes K̂⁻¹ lies between those of
/// both ends of an interval (18)-(20), with each one's own M, C and K on the right-hand side.
class NewmarkMotion final : public PartMotion {
public:
  struct Settings {
    double dt = 0.0;           ///< s
    std::int64_t interval = 0; ///< steps from one factor to the next; 0: nothing is taken
    Rayleigh damping;
  };
  /// follow: G, [3 · nodes × unknowns] (7). presence: [cell] 1 − D by a time, s.
  NewmarkMotion(Part part, SparseMatrix follow, const Settings& settings, PresenceAt presence);

  Eigen::VectorXd ask(const Eigen::VectorXd& load) const override;
  void take(const Eigen::VectorXd& load) override;
  void archive(Archive& archive) override;
  double frequency() const override;

  /// J, of the part as it was at the begin of the interval.
  double energy() const;

private:
  /// A state at an end of an interval.
  struct Frozen {
    Frozen(const NewmarkMotion& motion, double time);
    Matrices matrices;
    SparseCholesky factor;
    Eigen::MatrixXd answer; ///< 2 K̂⁻¹ Gᵀ, [unknowns × 3 · nodes]
    Eigen::MatrixXd seen;   ///< G of it
  };
  void prepare();
  void freeze(std::int64_t begin);
  double time(std::int64_t step) const { return static_cast<double>(step) * settings_.dt; }

  Part part_;
  SparseMatrix follow_;
  Settings settings_;
  PresenceAt presence_;
  NewmarkStep newmark_;
  std::int64_t step_ = 0, frozen_at_ = 0;
  Eigen::VectorXd q_, velocity_;                 ///< m, m/s
  std::shared_ptr<const Frozen> before_, after_; ///< of this interval
  double eta_ = 0.0;                             ///< of the end of this step, in it
  Eigen::VectorXd free_;                         ///< q at the end of this step without forces
};

} // namespace cnem::machining
