#include "machining/laws/oblique.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::machining {

Vec3 ObliqueLaw::pressures(double thickness) const {
  constexpr double unit = 1e-3;
  const double ratio = chip_ratio * std::pow(thickness / unit, chip_ratio_exponent);
  const double eta = inclination, t = std::tan(eta);
  const double beta = std::atan(std::tan(friction_angle) * std::cos(eta));
  // φn + βn − αn reaches a right angle where the shear force changes its sign: no chip flows there.
  constexpr double right = 1.5707963267948966;
  const double shear = std::min(std::atan2(ratio * std::cos(rake), 1.0 - ratio * std::sin(rake)),
                                0.999 * (right + rake - beta));
  const double across = std::cos(shear + beta - rake), along = t * std::sin(beta);
  const double c = std::hypot(across, along) * std::sin(shear);
  return shear_stress / c *
         Vec3(std::cos(beta - rake) + t * t * std::sin(beta), std::sin(beta - rake) / std::cos(eta),
              std::cos(beta - rake) * t - t * std::sin(beta));
}

LawPoint ObliqueLaw::at(const Cut& cut) const {
  const double h = cut.thickness;
  const Vec3 edge(Kte, Kre, Kae);
  const Vec3 pressure = pressures(h);
  if (chip_ratio_exponent == 0.0) return {pressure * h + edge, pressure};
  constexpr double near = 1e-4;
  const Vec3 change = (pressures(h * (1.0 + near)) - pressures(h * (1.0 - near))) / (2.0 * near);
  return {pressure * h + edge, pressure + change};
}

} // namespace cnem::machining
