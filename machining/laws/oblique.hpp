#pragma once
#include "machining/laws/law_point.hpp"

namespace cnem::machining {

/// Shear stress, friction angle and shear angle of orthogonal cuts on an edge that is inclined, after
/// Armarego: chip flow along η = i (Stabler), tan βn = tan β cos η,
///   c² = cos²(φn + βn − αn) + tan²η sin²βn,
///   Ktc = τ (cos(βn − αn) + tan i tan η sin βn)/(c sin φn),
///   Krc = τ sin(βn − αn)/(c sin φn cos i),
///   Kac = τ (cos(βn − αn) tan i − tan η sin βn)/(c sin φn),
/// and the shear angle from the chip ratio r (uncut over cut thickness): tan φn = r cos αn/(1 − r sin αn).
struct ObliqueLaw {
  double shear_stress = 0.0, friction_angle = 0.0, rake = 0.0; ///< Pa, rad, rad
  double chip_ratio = 0.0, chip_ratio_exponent = 0.0; ///< –, of a chip of 1 mm; – over the thickness
  double inclination = infinite;                      ///< rad; infinite: the helix angle of the cutter
  double Kte = 0.0, Kre = 0.0, Kae = 0.0;             ///< N/m

  static constexpr const char* name = "oblique";
  static constexpr const char* formula =
      "Kc h + Ke, Kc of τ, β, αn, i and the chip ratio r = chip_ratio (h/1 mm)^chip_ratio_exponent";
  static constexpr const char* source = "Armarego; Altintas, Manufacturing Automation, 2012";
  static constexpr Range angle{.low = -1.0471975511965976, .high = 1.0471975511965976};
  static constexpr Parameter<ObliqueLaw> parameters[] = {
      {&ObliqueLaw::shear_stress,
       {.name = "shear_stress",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "τ in the shear plane of an orthogonal cut.",
        .example = "613 MPa"}},
      {&ObliqueLaw::friction_angle,
       {.name = "friction_angle",
        .unit = "rad",
        .range = {.low = 0.0, .high = 1.3962634015954636},
        .required = true,
        .meaning = "β on the rake face.",
        .example = "22.6 deg"}},
      {&ObliqueLaw::rake,
       {.name = "rake",
        .unit = "rad",
        .range = angle,
        .required = true,
        .meaning = "αn, normal to the edge.",
        .example = "12 deg"}},
      {&ObliqueLaw::chip_ratio,
       {.name = "chip_ratio",
        .range = positive,
        .required = true,
        .meaning = "Uncut over cut chip thickness, of a chip of 1 mm.",
        .example = "1.42"}},
      {&ObliqueLaw::chip_ratio_exponent,
       {.name = "chip_ratio_exponent",
        .range = not_negative,
        .meaning = "How the ratio grows with the thickness.",
        .example = "0.23"}},
      {&ObliqueLaw::inclination,
       {.name = "inclination",
        .unit = "rad",
        .range = angle,
        .meaning = "i of the edge to the direction across its motion.",
        .example = "30 deg",
        .computed = "`cutter.helix`"}},
      {&ObliqueLaw::Kte, Kte_info},
      {&ObliqueLaw::Kre, Kre_info},
      {&ObliqueLaw::Kae, Kae_info}};

  /// (Ktc, Krc, Kac) in Pa at a chip thickness in m. The shear angle is kept from closing: a ratio whose
  /// shear plane would lie outside of the chip is taken at the last one inside.
  Vec3 pressures(double thickness) const;
  LawPoint at(const Cut& cut) const;
};

} // namespace cnem::machining
