#pragma once
#include "contact/friction_bound.hpp"
#include "contact/laws/coulomb.hpp"
#include "contact/laws/tresca_limited.hpp"

#include <numbers>

namespace cnem::contact {

/// Coulomb friction at low pressure that passes smoothly into the strength of the workpiece in shear, as the
/// surfaces flatten and touch everywhere: Shirakashi and Usui (J. Japan Soc. Precis. Eng. 39, 1973) for the
/// rake face of cutting tools, with the share shear_factor of the strength.
struct TrescaSmooth {
  double coefficient = 0.0, shear_factor = 1.0;

  static constexpr const char* name = "tresca-smooth";
  static constexpr const char* formula =
      "τ (1 − exp(−`coefficient` pressure/τ)), τ = `shear_factor` σ_y/√3: less than `tresca-limited` by at "
      "most τ/e, where the pressure is τ/`coefficient`";
  static constexpr const char* source = "Shirakashi and Usui 1973";
  static constexpr Parameter<TrescaSmooth> parameters[] = {
      {&TrescaSmooth::coefficient, Coulomb::parameters[0].info},
      {&TrescaSmooth::shear_factor, TrescaLimited::parameters[1].info}};

  bool needs_flow_stress() const { return coefficient > 0.0; }
  FrictionBound bound(const Rubbing& at) const {
    return {.coefficient = coefficient,
            .shear = shear_factor * at.flow_stress / std::numbers::sqrt3,
            .smooth = true};
  }
};

} // namespace cnem::contact
