#include "plasticity/material.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::plasticity {

double Elasticity::dilatational_speed(double density) const {
  return std::sqrt((lambda() + 2.0 * mu()) / density);
}
double Elasticity::shear_speed(double density) const { return std::sqrt(mu() / density); }
double Elasticity::bar_speed(double density) const { return std::sqrt(young / density); }

double Material::melting_temperature() const {
  return std::min(hardening ? hardening->melting_temperature() : infinite,
                  damage ? damage->melting_temperature() : infinite);
}

double Damage::melting_temperature() const {
  const auto* johnson_cook = std::get_if<JohnsonCookDamage>(&law);
  return johnson_cook ? johnson_cook->Tmelt : infinite;
}

} // namespace cnem::plasticity
