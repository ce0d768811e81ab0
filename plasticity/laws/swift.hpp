#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/johnson_cook.hpp"

namespace cnem::plasticity {

/// Power hardening of Swift (J. Mech. Phys. Solids 1, 1952) of metal that has been strained before, at any
/// rate and temperature: what tables of sheet metal give.
struct Swift {
  double K = 0.0, strain0 = 0.0, n = 1.0;

  static constexpr const char* name = "swift";
  static constexpr const char* formula = "K (strain0 + ε̄p)ⁿ";
  static constexpr const char* source = "Swift 1952";
  static constexpr Parameter<Swift> parameters[] = {
      {&Swift::K,
       {.name = "K",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Flow stress at strain0 + ε̄p = 1.",
        .example = "950 MPa"}},
      {&Swift::strain0,
       {.name = "strain0",
        .range = positive,
        .required = true,
        .meaning = "Strain before: the metal yields at K strain0ⁿ.",
        .example = "0.01"}},
      {&Swift::n, JohnsonCook::parameters[2].info}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Swift& law, N strain, N, T) {
  return T(law.K) * power(T(law.strain0) + strain, law.n);
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
