#pragma once
// The motion of a part from which a tool takes matter: paper 004, section 3.3 and Box 1.
#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/newmark.hpp"
#include "machining/structure/part.hpp"

#include <functional>
#include <span>
#include <vector>

namespace cnem::machining {

/// How K̂(p(t)) is inverted between the times at which it is factored.
enum class EffectiveInverse {
  conjugate_gradients, ///< with the factor at hand before it, to 1e-10
  interpolated,        ///< (18)-(20), Q̄ of each frozen system of its own M and C
  interpolated_common, ///< as printed: one Q_total of the present M and C for both
  factored,            ///< in each step
};

struct RemovalSettings {
  double dt = 0.0;           ///< s
  std::int64_t steps = 0;    ///< until the end
  std::int64_t interval = 1; ///< steps from one factor to the next
  Rayleigh damping;          ///< C = α M + β K
  EffectiveInverse inverse = EffectiveInverse::conjugate_gradients;
};

/// [cell] 1 − D that the theoretical tool, of a rigid run, has left by a time, s.
using PresenceAt = std::function<std::vector<double>(double time)>;
/// Forces on the unknowns, N, at a time and a trial of q there.
using LoadAt = std::function<Eigen::VectorXd(double time, const Eigen::VectorXd& trial)>;

/// J since the begin.
struct EnergyLedger {
  double kinetic = 0.0, elastic = 0.0; ///< of what is there
  double work = 0.0;                   ///< of the forces
  double damping = 0.0;                ///< lost
  double chips = 0.0;                  ///< left with what was taken

  /// What does not add up: 0 but for what an inverse is not exact by, and for matter that goes within a step.
  double imbalance() const { return kinetic + elastic + damping + chips - work; }
};

struct RemovalStep {
  double time = 0.0; ///< s, at the end
  const Motion& motion;
  const EnergyLedger& energy;
  int iterations = 0; ///< of conjugate gradients, in all trials
};

/// Box 1: over all intervals, and all their steps, trial values of q until the forces that they make give
/// them back. `observe` sees each step. Throws DivergenceError where trials do not come together in 50, or
/// the motion is no number any more.
void machine(const Part& part, const RemovalSettings& settings, Motion motion, const PresenceAt& presence,
             const LoadAt& load, const std::function<void(const RemovalStep&)>& observe);

/// 1 − D of cells of which a box is taken, times what is there: D = `most` times the share that the box has
/// of the cell, which comes to `most` without a kink that intervals would not see.
std::vector<double> presence_without(const Part& part, const Vec3& low, const Vec3& high, double most);

/// K̂ q = load to a share of the load, by conjugate gradients with a factor before them; q: where it begins,
/// then the solution. Returns iterations; throws DivergenceError after 1000.
int conjugate_gradients(const SparseMatrix& effective, const SparseCholesky& factor,
                        const Eigen::VectorXd& load, double tolerance, Eigen::VectorXd& q);

} // namespace cnem::machining
