#pragma once
#include "machining/laws/law_point.hpp"

namespace cnem::machining {

/// Forces in proportion to the chip thickness, and edge forces (Altintas, Manufacturing Automation, 2.3).
struct LinearLaw {
  double Ktc = 0.0, Krc = 0.0, Kac = 0.0; ///< Pa
  double Kte = 0.0, Kre = 0.0, Kae = 0.0; ///< N/m

  static constexpr const char* name = "linear";
  static constexpr const char* formula = "Kc h + Ke, tangential, radial and axial";
  static constexpr const char* source = "Altintas, Manufacturing Automation, 2012";
  static constexpr Parameter<LinearLaw> parameters[] = {
      {&LinearLaw::Ktc,
       {.name = "Ktc",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Tangential force per area of chip.",
        .example = "767 MPa"}},
      {&LinearLaw::Krc,
       {.name = "Krc", .unit = "Pa", .meaning = "Radial force per area of chip.", .example = "168.8 MPa"}},
      {&LinearLaw::Kac,
       {.name = "Kac", .unit = "Pa", .meaning = "Axial force per area of chip.", .example = "222 MPa"}},
      {&LinearLaw::Kte, Kte_info},
      {&LinearLaw::Kre, Kre_info},
      {&LinearLaw::Kae, Kae_info}};

  LawPoint at(const Cut& cut) const {
    const Vec3 slope(Ktc, Krc, Kac);
    return {slope * cut.thickness + Vec3(Kte, Kre, Kae), slope};
  }
};

} // namespace cnem::machining
