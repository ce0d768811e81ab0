#pragma once
// When conduction acts: explicit steps of motion are thousands of times shorter than those of heat.
#include "core/fields/archive.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cnem {

/// Gathers steps of motion until conduction is due: after a hundredth of its own stable step, or sixteen
/// steps. A mode of decay rate r loses r τ in the interval τ instead of r τ (1 − r τ/2 …), r τ ≤ 2/100.
struct ConductionInterval {
  static constexpr double share = 0.01; ///< of the stable step
  static constexpr int most = 16;

  double stable = 0.0;  ///< s, stable for heat when it was measured last; 0: to be measured
  double pending = 0.0; ///< s, since conduction acted last
  int steps = 0;        ///< in that time

  /// Adds a step of dt (s); the interval when it is due, which then begins anew, else 0. Expects `stable`.
  double add(double dt) {
    pending += dt;
    if (++steps < most && pending + dt <= share * stable) return 0.0;
    steps = 0;
    const double interval = pending;
    pending = 0.0;
    return interval;
  }

  void archive(Archive& archive, const std::string& at) {
    archive.number(at + "conduction_step", "s", stable);
    archive.number(at + "conduction_pending", "s", pending);
    archive.integer(at + "conduction_steps", steps);
  }
};

/// Explicit sub-steps for an interval times the decay rate.
inline int stable_substeps(double decays) { return std::max(1, static_cast<int>(std::ceil(decays / 1.8))); }

} // namespace cnem
