#pragma once
// The motion of a part from which a tool takes matter: paper 004, section 3.3 and Box 1.
#include "core/fields/archive.hpp"
#include "machining/structure/eigenmodes.hpp"
#include "machining/structure/energy_ledger.hpp"
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
  std::int64_t steps = 0;    ///< at the end, counted from the time 0
  std::int64_t interval = 1; ///< steps from one factor to the next
  Rayleigh damping;          ///< C = α M + β K
  EffectiveInverse inverse = EffectiveInverse::conjugate_gradients;
};

/// [cell] 1 − D that the theoretical tool, of a rigid run, has left by a time, s.
using PresenceAt = std::function<std::vector<double>(double time)>;
/// Forces on the unknowns, N, at a time and a trial of q there.
using LoadAt = std::function<Eigen::VectorXd(double time, const Eigen::VectorXd& trial)>;

/// Where a part is at the begin of an interval: all that the intervals from there on depend on.
struct RemovalState {
  std::int64_t step = 0;
  Motion motion;
  EnergyLedger energy;
  Eigen::VectorXd force; ///< N, at that time; found anew at step 0

  static RemovalState at_rest(Eigen::Index unknowns);
  /// Under a path of names that ends with "/".
  void archive(Archive& archive, const std::string& path);
};

struct RemovalStep {
  double time = 0.0; ///< s, at the end
  const Motion& motion;
  const EnergyLedger& energy;
  int iterations = 0; ///< of conjugate gradients, in all trials
};

/// Box 1: over all intervals from a state to settings.steps, and all their steps, trial values of q until the
/// forces that they make give them back. The state is that of the end, and going on from there gives the same
/// bits. `observe` sees each step. Throws DivergenceError where trials do not come together in 50, or the
/// motion is no number any more.
void machine(const Part& part, const RemovalSettings& settings, RemovalState& state,
             const PresenceAt& presence, const LoadAt& load,
             const std::function<void(const RemovalStep&)>& observe);

/// 1 − D of cells of which a box is taken, times what is there: D = `most` times the share that the box has
/// of the cell, which comes to `most` without a kink that intervals would not see.
std::vector<double> presence_without(const Part& part, const Vec3& low, const Vec3& high, double most);

/// K̂ q = load to a share of the load, by conjugate gradients with a factor before them; q: where it begins,
/// then the solution. Returns iterations; throws DivergenceError after 1000.
int conjugate_gradients(const SparseMatrix& effective, const SparseCholesky& factor,
                        const Eigen::VectorXd& load, double tolerance, Eigen::VectorXd& q);

} // namespace cnem::machining
