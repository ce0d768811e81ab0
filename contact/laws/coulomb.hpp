#pragma once
#include "contact/friction_bound.hpp"

namespace cnem::contact {

struct Coulomb {
  double coefficient = 0.0, shear_limit = infinite;

  static constexpr const char* name = "coulomb";
  static constexpr const char* formula = "`coefficient` times the pressure, at most `shear_limit`";
  static constexpr const char* source = "";
  static constexpr Parameter<Coulomb> parameters[] = {
      {&Coulomb::coefficient,
       {.name = "coefficient", .range = not_negative, .required = true, .meaning = "μ.", .example = "0.1"}},
      {&Coulomb::shear_limit,
       {.name = "shear_limit",
        .unit = "Pa",
        .range = not_negative,
        .meaning = "Largest shear stress of friction, whatever the pressure; no limit without it.",
        .example = "220 MPa"}}};

  FrictionBound bound(const Rubbing&) const { return {.coefficient = coefficient, .shear = shear_limit}; }
};

} // namespace cnem::contact
