#pragma once
#include "contact/friction_bound.hpp"

namespace cnem::contact {

struct Coulomb {
  double coefficient = 0.0;

  static constexpr const char* name = "coulomb";
  static constexpr const char* formula = "`coefficient` times the pressure";
  static constexpr const char* source = "";
  static constexpr Parameter<Coulomb> parameters[] = {
      {&Coulomb::coefficient,
       {.name = "coefficient", .range = not_negative, .required = true, .meaning = "μ.", .example = "0.1"}}};

  FrictionBound bound(const Rubbing&) const { return {.coefficient = coefficient}; }
};

} // namespace cnem::contact
