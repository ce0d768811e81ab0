#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/linear.hpp"

namespace cnem::plasticity {

/// Hardening of the blanking steel X30Cr13 by Goijaerts, Govaert and Baaijens (ASME J. Manuf. Sci. Eng. 122,
/// 2000, p. 476), at any rate and temperature: a part that saturates, one with the root of the strain and a
/// linear one. The examples are their constants.
struct Goijaerts {
  double yield = 0.0, rise = 0.0, rise_strain = 1.0, root = 0.0, hardening = 0.0;

  static constexpr const char* name = "goijaerts";
  static constexpr const char* formula = "yield + rise (1 − exp(−ε̄p/rise_strain)) + root √ε̄p + hardening ε̄p";
  static constexpr const char* source = "Goijaerts, Govaert and Baaijens 2000";
  static constexpr Parameter<Goijaerts> parameters[] = {
      {&Goijaerts::yield, Linear::parameters[0].info},
      {&Goijaerts::rise,
       {.name = "rise",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "What the part that saturates adds.",
        .example = "133 MPa"}},
      {&Goijaerts::rise_strain,
       {.name = "rise_strain",
        .range = positive,
        .required = true,
        .meaning = "Plastic strain over which it saturates.",
        .example = "0.0567"}},
      {&Goijaerts::root,
       {.name = "root",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "What the part with the root has added at ε̄p = 1.",
        .example = "406 MPa"}},
      {&Goijaerts::hardening, Linear::parameters[1].info}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Goijaerts& law, N strain, N, T) {
  return T(law.yield) + T(law.rise) * (T(1.0) - exponential(T(-1.0 / law.rise_strain) * strain)) +
         T(law.root) * power(strain, 0.5) + T(law.hardening) * strain;
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
