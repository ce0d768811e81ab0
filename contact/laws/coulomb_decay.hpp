#pragma once
#include "contact/friction_bound.hpp"

#include <cmath>

namespace cnem::contact {

/// Coulomb friction that falls with the speed of slip, as of metals that slide fast (Oden and Martins,
/// Comput. Methods Appl. Mech. Eng. 52, 1985). The speed is that of the prediction, before friction acts.
struct CoulombDecay {
  double static_coefficient = 0.0, kinetic_coefficient = 0.0, decay_speed = 1.0;

  static constexpr const char* name = "coulomb-decay";
  static constexpr const char* formula = "kinetic_coefficient + (static_coefficient − kinetic_coefficient) "
                                         "exp(−v/decay_speed) times the pressure, v "
                                         "the speed of slip";
  static constexpr const char* source = "Oden and Martins 1985";
  static constexpr Parameter<CoulombDecay> parameters[] = {{&CoulombDecay::static_coefficient,
                                                            {.name = "static_coefficient",
                                                             .range = not_negative,
                                                             .required = true,
                                                             .meaning = "μ at rest.",
                                                             .example = "0.15"}},
                                                           {&CoulombDecay::kinetic_coefficient,
                                                            {.name = "kinetic_coefficient",
                                                             .range = not_negative,
                                                             .required = true,
                                                             .meaning = "μ of fast slip.",
                                                             .example = "0.05"}},
                                                           {&CoulombDecay::decay_speed,
                                                            {.name = "decay_speed",
                                                             .unit = "m/s",
                                                             .range = positive,
                                                             .required = true,
                                                             .meaning = "Speed of slip over which μ falls.",
                                                             .example = "2 m/s"}}};
  static constexpr Order orders[] = {{"static_coefficient", "kinetic_coefficient", true}};

  bool needs_speed() const { return true; }
  FrictionBound bound(const Rubbing& at) const {
    return {.coefficient = kinetic_coefficient +
                           (static_coefficient - kinetic_coefficient) * std::exp(-at.speed / decay_speed)};
  }
};

} // namespace cnem::contact
