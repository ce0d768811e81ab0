#pragma once
#include "machining/laws/law_point.hpp"

#include <cmath>

namespace cnem::machining {

/// Kienzle's power of the chip thickness (Kienzle 1952). The slope is without bound at h = 0 where an
/// exponent is not 0; its integral over h is the force.
struct KienzleLaw {
  double Kt1 = 0.0, Kr1 = 0.0, Ka1 = 0.0; ///< Pa, at a chip of 1 mm
  double mt = 0.0, mr = 0.0, ma = 0.0;    ///< –

  static constexpr const char* name = "kienzle";
  static constexpr const char* formula = "K1 h₁ (h/h₁)^(1 − m), h₁ = 1 mm, tangential, radial and axial";
  static constexpr const char* source = "Kienzle, VDI-Z 94, 1952";
  static constexpr Range exponent{.low = 0.0, .high = 1.0, .high_open = true};
  static constexpr Parameter<KienzleLaw> parameters[] = {
      {&KienzleLaw::Kt1,
       {.name = "Kt1",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Tangential force per area of a chip of 1 mm.",
        .example = "1.8 GPa"}},
      {&KienzleLaw::Kr1, {.name = "Kr1", .unit = "Pa", .meaning = "The same, radial.", .example = "600 MPa"}},
      {&KienzleLaw::Ka1, {.name = "Ka1", .unit = "Pa", .meaning = "The same, axial.", .example = "300 MPa"}},
      {&KienzleLaw::mt,
       {.name = "mt", .range = exponent, .meaning = "Exponent of `Kt1`.", .example = "0.25"}},
      {&KienzleLaw::mr, {.name = "mr", .range = exponent, .meaning = "Exponent of `Kr1`.", .example = "0.3"}},
      {&KienzleLaw::ma,
       {.name = "ma", .range = exponent, .meaning = "Exponent of `Ka1`.", .example = "0.3"}}};

  LawPoint at(const Cut& cut) const {
    constexpr double unit = 1e-3;
    LawPoint point;
    const Vec3 constant(Kt1, Kr1, Ka1), power(mt, mr, ma);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double pressure = constant[k] * std::pow(cut.thickness / unit, -power[k]);
      point.force[k] = pressure * cut.thickness;
      point.slope[k] = (1.0 - power[k]) * pressure;
    }
    return point;
  }
};

} // namespace cnem::machining
