#include "plasticity/material.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::plasticity {

double Elasticity::dilatational_speed(double density) const {
  return std::sqrt((lambda() + 2.0 * mu()) / density);
}
double Elasticity::shear_speed(double density) const { return std::sqrt(mu() / density); }
double Elasticity::bar_speed(double density) const { return std::sqrt(young / density); }

Elasticity Elasticity::with_bulk_modulus(double kappa) const {
  const double shear = mu(), both = 3.0 * kappa + shear;
  return {9.0 * kappa * shear / both, (1.5 * kappa - shear) / both};
}

HillCoefficients Material::yield_coefficients() const {
  return anisotropy ? anisotropy->coefficients() : Hill48{}.coefficients();
}

double Material::shear_modulus() const { return ply ? ply->G12 : elasticity.mu(); }

double Material::wave_modulus(bool stress_free) const {
  if (ply) return ply_constants(*ply, stress_free).stiffness().largest_eigenvalue();
  if (stress_free) return elasticity.young / (1.0 - elasticity.poisson * elasticity.poisson);
  return elasticity.lambda() + 2.0 * elasticity.mu();
}

double Material::fastest_wave() const { return std::sqrt(wave_modulus() / density); }

double Material::melting_temperature() const {
  return std::min(hardening ? hardening->melting_temperature() : infinite,
                  damage ? damage->melting_temperature() : infinite);
}

double Damage::melting_temperature() const {
  const auto* johnson_cook = std::get_if<JohnsonCookDamage>(&law);
  return johnson_cook ? johnson_cook->Tmelt : infinite;
}

} // namespace cnem::plasticity
