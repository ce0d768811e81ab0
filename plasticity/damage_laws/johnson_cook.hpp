#pragma once
#include "core/parameter.hpp"
#include "plasticity/damage_laws/flowing.hpp"

namespace cnem::plasticity {

/// Fracture strain of Johnson and Cook (Eng. Fract. Mech. 21, 1985). T* and ln⁺ as in JohnsonCook. Metals do
/// not break under a mean pressure above that of uniaxial compression (Bao and Wierzbicki, Eng. Fract. Mech.
/// 72, 2005), which the formula, fitted to tension and torsion, does not know: hence the cut-off.
struct JohnsonCookDamage {
  double D1 = 0.0, D2 = 0.0, D3 = 0.0, D4 = 0.0, D5 = 0.0;
  double rate0 = 1.0, T0 = 293.15, Tmelt = infinite, cut_off = -1.0 / 3.0;

  static constexpr const char* name = "johnson-cook";
  static constexpr const char* formula =
      "damage grows by dε̄p/ε_f, ε_f = [D1 + D2 exp(D3 σ*)] [1 + D4 ln(ε̄̇p/rate0)] [1 + D5 T*], σ* = mean "
      "stress over von Mises stress, positive in tension";
  static constexpr const char* source = "Johnson and Cook 1985";
  static constexpr Parameter<JohnsonCookDamage> parameters[] = {
      {&JohnsonCookDamage::D1,
       {.name = "D1", .required = true, .meaning = "Fracture strain under high tension.", .example = "0.05"}},
      {&JohnsonCookDamage::D2,
       {.name = "D2", .required = true, .meaning = "Fracture strain in shear, less D1.", .example = "3.44"}},
      {&JohnsonCookDamage::D3,
       {.name = "D3",
        .required = true,
        .meaning =
            "Negative where tension makes the material less ductile: some tables give it for exp(−D3 σ*).",
        .example = "-2.12"}},
      {&JohnsonCookDamage::D4, {.name = "D4", .meaning = "Influence of the rate; none below `rate0`."}},
      {&JohnsonCookDamage::D5, {.name = "D5", .meaning = "Influence of the temperature."}},
      {&JohnsonCookDamage::rate0,
       {.name = "rate0",
        .unit = "1/s",
        .range = positive,
        .meaning = "Reference strain rate.",
        .computed = "`plastic.rate0`, else 1 /s"}},
      {&JohnsonCookDamage::T0,
       {.name = "T0",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Temperature at which T* is 0.",
        .example = "293.15 K",
        .computed = "`plastic.T0`, else 293.15 K"}},
      {&JohnsonCookDamage::Tmelt,
       {.name = "Tmelt",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Melting temperature, at which T* is 1; without it T* is 0.",
        .example = "1793 K",
        .computed = "`plastic.Tmelt`"}},
      {&JohnsonCookDamage::cut_off,
       {.name = "cut_off",
        .meaning = "No damage grows at this σ* or below: that of uniaxial compression, where metals cease to "
                   "break, unless given.",
        .source = "Bao and Wierzbicki 2005",
        .example = "-0.3333"}}};
  static constexpr Order orders[] = {{"Tmelt", "T0"}};

  /// ε_f at a triaxiality, rate (1/s) and temperature (K).
  double fracture_strain(double triaxiality, double rate, double temperature) const;
};

namespace CNEM_ISA {

template<class T> CNEM_INLINE Mask<T> breaks(const JohnsonCookDamage& law, const Flowing<T>& at) {
  return at.triaxiality > T(law.cut_off);
}

template<class T> CNEM_INLINE T fracture_strain(const JohnsonCookDamage& law, const Flowing<T>& at) {
  const double by_rate0 = 1.0 / law.rate0, by_melting_range = 1.0 / (law.Tmelt - law.T0);
  const T exponent = min(max(T(law.D3) * at.triaxiality, T(-700.0)), T(700.0));
  T strain = T(law.D1) + T(law.D2) * exp(exponent);
  if (law.D4 != 0.0) strain = strain * (T(1.0) + T(law.D4) * log(max(at.rate * T(by_rate0), T(1.0))));
  const T homologous = min(max((at.temperature - T(law.T0)) * T(by_melting_range), T(0.0)), T(1.0));
  return strain * (T(1.0) + T(law.D5) * homologous);
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
