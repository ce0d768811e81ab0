#include "plasticity/material.hpp"

#include <cmath>

namespace cnem::plasticity {

double Elasticity::dilatational_speed(double density) const {
  return std::sqrt((lambda() + 2.0 * mu()) / density);
}
double Elasticity::shear_speed(double density) const { return std::sqrt(mu() / density); }
double Elasticity::bar_speed(double density) const { return std::sqrt(young / density); }

} // namespace cnem::plasticity
