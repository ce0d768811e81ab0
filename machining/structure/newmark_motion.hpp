#pragma once
// A part that is not reduced to modes while it is milled, and loses what the tool takes: paper 004, Box 1.
#include "machining/flexible_part.hpp"
#include "machining/structure/removal.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace cnem::machining {

/// [cell] 1 − D that the theoretical tool, of a rigid run, has left at the begin of a step.
using PresenceAtStep = std::function<std::vector<double>(std::int64_t step)>;

/// All unknowns of a part by Newmark's scheme with 1/4 and 1/2, under the mean force of each step: the
/// equilibrium at its end, (11), with 2 Q_mean − Q of its begin. While matter goes K̂⁻¹ lies between those of
/// both ends of an interval (18)-(20), with each one's own M, C and K on the right-hand side. Energies are
/// those of M, C and K in the same proportion; matter leaves at the begin of a step.
class NewmarkMotion final : public PartMotion {
public:
  struct Settings {
    std::int64_t interval = 0; ///< steps from one factor to the next; 0: nothing is taken
    Rayleigh damping;
  };
  /// follow: G, [3 · nodes × unknowns] (7).
  NewmarkMotion(Part part, SparseMatrix follow, const Settings& settings, PresenceAtStep presence);

  /// Factors anew where the duration is another one, by more than 1e-8 of itself.
  void begin(double dt) override;
  Eigen::VectorXd ask(const Eigen::VectorXd& load) const override;
  void take(const Eigen::VectorXd& load) override;
  void rest() override;
  void archive(Archive& archive) override;
  double frequency() const override;

private:
  /// A state at an end of an interval.
  struct Frozen {
    Frozen(const NewmarkMotion& motion, std::int64_t step);
    Matrices matrices;
    SparseCholesky factor;
    Eigen::MatrixXd answer; ///< 2 K̂⁻¹ Gᵀ, [unknowns × 3 · nodes]
    Eigen::MatrixXd seen;   ///< G of it
  };
  struct Held { // J
    double kinetic = 0.0, elastic = 0.0;
  };
  /// begin: of the interval. another: steps are as long as no frozen state knows.
  void freeze(std::int64_t begin, bool another);
  std::int64_t interval_begin() const {
    return settings_.interval > 0 ? step_ - step_ % settings_.interval : 0;
  }
  bool changes() const { return before_ != after_; } ///< in this interval
  void weigh();
  /// With the matter that is there at the end of this step.
  Held held() const;

  Part part_;
  SparseMatrix follow_;
  Settings settings_;
  PresenceAtStep presence_;
  NewmarkStep newmark_{1.0};
  double dt_ = 0.0, taken_dt_ = 0.0; ///< s, of the factors now, and in the last step
  std::int64_t step_ = 0, frozen_at_ = 0;
  Eigen::VectorXd q_, velocity_;                 ///< m, m/s
  std::shared_ptr<const Frozen> before_, after_; ///< of this interval
  Held held_before_, held_after_;                ///< now, with the matter of either
  double eta_ = 0.0;                             ///< of the end of this step, in it
  Eigen::VectorXd free_;                         ///< q at the end of this step without forces
};

} // namespace cnem::machining
