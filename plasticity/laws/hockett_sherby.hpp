#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/voce.hpp"

namespace cnem::plasticity {

/// Saturating hardening of Hockett and Sherby (J. Mech. Phys. Solids 23, 1975), at any rate and temperature:
/// Voce's with a power of the strain, which fits sheet metal to larger strains.
struct HockettSherby {
  double yield = 0.0, saturation = 0.0, N = 0.0, p = 1.0;

  static constexpr const char* name = "hockett-sherby";
  static constexpr const char* formula = "saturation − (saturation − yield) exp(−N ε̄pᵖ)";
  static constexpr const char* source = "Hockett and Sherby 1975";
  static constexpr Parameter<HockettSherby> parameters[] = {
      {&HockettSherby::yield, Linear::parameters[0].info},
      {&HockettSherby::saturation, Voce::parameters[2].info},
      {&HockettSherby::N,
       {.name = "N",
        .range = positive,
        .required = true,
        .meaning = "How fast it saturates.",
        .example = "4.5"}},
      {&HockettSherby::p,
       {.name = "p",
        .range = positive,
        .required = true,
        .meaning = "Exponent of the strain in it; 1 is Voce's law.",
        .example = "0.8"}}};
  static constexpr Order orders[] = {{"saturation", "yield", true}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const HockettSherby& law, N strain, N, T) {
  return T(law.saturation) - T(law.saturation - law.yield) * exponential(T(-law.N) * power(strain, law.p));
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
