#pragma once
#include "contact/friction_bound.hpp"
#include "contact/laws/coulomb.hpp"

#include <numbers>

namespace cnem::contact {

/// Coulomb friction up to the strength of the workpiece in shear, of which shear_factor is borne.
struct TrescaLimited {
  double coefficient = 0.0, shear_factor = 1.0;

  static constexpr const char* name = "tresca-limited";
  static constexpr const char* formula = "`coefficient` times the pressure, at most `shear_factor` σ_y/√3";
  static constexpr const char* source = "Orowan 1943";
  static constexpr Parameter<TrescaLimited> parameters[] = {
      {&TrescaLimited::coefficient, Coulomb::parameters[0].info},
      {&TrescaLimited::shear_factor, {.name = "shear_factor", .range = fraction, .meaning = "m_f."}}};

  bool needs_flow_stress() const { return coefficient > 0.0; }
  FrictionBound bound(const Rubbing& at) const {
    return {.coefficient = coefficient, .shear = shear_factor * at.flow_stress / std::numbers::sqrt3};
  }
};

} // namespace cnem::contact
