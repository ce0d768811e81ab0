#include "plasticity/material.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::plasticity {

double Elasticity::dilatational_speed(double density) const {
  return std::sqrt((lambda() + 2.0 * mu()) / density);
}
double Elasticity::shear_speed(double density) const { return std::sqrt(mu() / density); }
double Elasticity::bar_speed(double density) const { return std::sqrt(young / density); }

double JohnsonCook::homologous_temperature(double temperature) const {
  return std::clamp((temperature - T0) / (Tmelt - T0), 0.0, 1.0);
}

namespace {

double hardened(const JohnsonCook& jc, double plastic_strain) {
  return jc.A + jc.B * std::pow(plastic_strain, jc.n) +
         jc.saturation * (1.0 - std::exp(-jc.saturation_exponent * plastic_strain));
}

double softening(const JohnsonCook& jc, double temperature) {
  return 1.0 - std::pow(jc.homologous_temperature(temperature), jc.m);
}

double rate_factor(const JohnsonCook& jc, double rate) {
  return 1.0 + jc.C * std::log(std::max(rate / jc.rate0, 1.0));
}

} // namespace

double JohnsonCook::flow_stress(double plastic_strain, double rate, double temperature) const {
  return hardened(*this, plastic_strain) * rate_factor(*this, rate) * softening(*this, temperature);
}

double JohnsonCook::hardening_modulus(double plastic_strain, double rate, double temperature) const {
  double slope = saturation * saturation_exponent * std::exp(-saturation_exponent * plastic_strain);
  if (B > 0.0) slope += n * B * std::pow(plastic_strain, n - 1.0);
  return slope * rate_factor(*this, rate) * softening(*this, temperature);
}

double JohnsonCook::rate_modulus(double plastic_strain, double rate, double temperature) const {
  if (rate <= rate0) return 0.0;
  return hardened(*this, plastic_strain) * C / rate * softening(*this, temperature);
}

} // namespace cnem::plasticity
