#include "plasticity/cohesive.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::plasticity {
namespace {

/// What tears: compression does not.
Vec2 opening(const Vec2& separation) { return {std::max(separation.x(), 0.0), separation.y()}; }

} // namespace

void CohesiveLaw::complete() {
  if (shear_strength == infinite) shear_strength = strength;
  if (shear_energy == infinite) shear_energy = energy;
  constexpr int modes = 100;
  for (int m = 0; m <= modes; ++m) {
    const double mode = static_cast<double>(m) / modes;
    if (end(mode) > onset(mode)) continue;
    const double stored = 0.5 * stiffness * onset(mode) * onset(mode);
    throw InputError(
        fmt::format("the fracture energy of {:.0f}% shear is {:.4g} J/m2 and {:.4g} J/m2 are stored "
                    "at onset already, expected more energy, more stiffness or less strength",
                    100.0 * mode, 0.5 * stiffness * onset(mode) * end(mode), stored));
  }
}

double CohesiveLaw::onset(double mode) const {
  const double opens = (1.0 - mode) / (strength * strength),
               slides = mode / (shear_strength * shear_strength);
  return 1.0 / (stiffness * std::sqrt(opens + slides));
}

double CohesiveLaw::end(double mode) const {
  return 2.0 * (energy + (shear_energy - energy) * std::pow(mode, eta)) / (stiffness * onset(mode));
}

double CohesiveLaw::damage_at(const Vec2& separation, double damage) const {
  const Vec2 open = opening(separation);
  const double effective2 = open.squaredNorm();
  if (damage >= 1.0 || effective2 == 0.0) return damage;
  const double mode = open.y() * open.y() / effective2, first = onset(mode);
  const double effective = std::sqrt(effective2);
  if (effective <= first) return damage;
  const double last = end(mode);
  if (effective >= last) return 1.0;
  return std::max(damage, last * (effective - first) / (effective * (last - first)));
}

Vec2 CohesiveLaw::traction(const Vec2& separation, double damage) const {
  const double left = (1.0 - damage) * stiffness;
  return {(separation.x() > 0.0 ? left : stiffness) * separation.x(), left * separation.y()};
}

double CohesiveLaw::stored(const Vec2& separation, double damage) const {
  return 0.5 * separation.dot(traction(separation, damage));
}

double CohesiveLaw::dissipated(const Vec2& from, const Vec2& to, double growth) const {
  return 0.5 * stiffness * opening(from).dot(opening(to)) * growth;
}

} // namespace cnem::plasticity
