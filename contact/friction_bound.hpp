#pragma once
// What a law of friction is asked, and what it answers: once per contact and step, before the impulses are
// known.
#include "core/parameter.hpp"

namespace cnem::contact {

/// A contact as the predictor left it.
struct Rubbing {
  double flow_stress = 0.0;  ///< Pa, of the weaker of two bodies; 0 unless the law needs it
  double speed = 0.0;        ///< m/s, of slip; 0 unless the law needs it
  double temperature = 0.0;  ///< K, of the workpiece there, of two bodies the higher one
  double melting = infinite; ///< K, of the workpiece, of two bodies the lower one
};

/// F_t ≤ min(μ F_n, τ A), or τ A (1 − exp(−μ F_n/τ A)) where the one shall pass smoothly into the other.
struct FrictionBound {
  double coefficient = 0.0; ///< –, μ ≥ 0; may be infinite
  double shear = infinite;  ///< Pa, τ ≥ 0; finite where `smooth`
  bool smooth = false;
};

} // namespace cnem::contact
