#pragma once
#include "core/parameter.hpp"
#include "plasticity/damage_laws/flowing.hpp"

namespace cnem::plasticity {

/// Cockcroft and Latham's law by the flow stress, so that its constant is a strain and hardly depends on how
/// much the metal hardens (Oh, Chen and Kobayashi, J. Eng. Ind. 101, 1979).
struct NormalisedCockcroftLatham {
  double critical_strain = 0.0;

  static constexpr const char* name = "cockcroft-latham-normalised";
  static constexpr const char* formula =
      "damage grows by max(σ1, 0)/σ_eq dε̄p/critical_strain, σ1 the largest principal stress";
  static constexpr const char* source = "Oh, Chen and Kobayashi 1979";
  static constexpr bool of_largest_stress = true;
  static constexpr Parameter<NormalisedCockcroftLatham> parameters[] = {
      {&NormalisedCockcroftLatham::critical_strain,
       {.name = "critical_strain",
        .range = positive,
        .required = true,
        .meaning = "∫ max(σ1, 0)/σ_eq dε̄p at fracture, the fracture strain of uniaxial tension.",
        .example = "0.6"}}};
};

namespace CNEM_ISA {

template<class T> CNEM_INLINE T fracture_strain(const NormalisedCockcroftLatham& law, const Flowing<T>& at) {
  return T(law.critical_strain) * at.equivalent / max(at.largest, T(1e-100));
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
