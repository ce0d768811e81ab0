#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/linear.hpp"
#include "plasticity/power_kernel.hpp"

namespace cnem::plasticity {

/// Saturating hardening of Voce (1948) with a linear part, at any rate and temperature: what the
/// finite-strain benchmarks of the literature need (Simo and Armero 1992).
struct Voce {
  double yield = 0.0, hardening = 0.0, saturation = 0.0, exponent = 0.0;

  static constexpr const char* name = "voce";
  static constexpr const char* formula = "yield + hardening ε̄p + (saturation − yield)(1 − exp(−exponent ε̄p))";
  static constexpr const char* source = "Voce 1948";
  static constexpr Parameter<Voce> parameters[] = {
      {&Voce::yield, Linear::parameters[0].info},
      {&Voce::hardening, Linear::parameters[1].info},
      {&Voce::saturation,
       {.name = "saturation",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "What `yield` saturates to, without the linear part.",
        .example = "715 MPa"}},
      {&Voce::exponent,
       {.name = "exponent",
        .range = positive,
        .required = true,
        .meaning = "How fast it saturates, per plastic strain.",
        .example = "16.93"}}};
  static constexpr Order orders[] = {{"saturation", "yield", true}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Voce& law, N strain, N, T) {
  return T(law.yield) + T(law.hardening) * strain +
         T(law.saturation - law.yield) * (T(1.0) - exponential(T(-law.exponent) * strain));
}

CNEM_INLINE PowerKernel<true> kernel_of(const Voce& law, double dt) {
  return {{.A = law.yield,
           .B = law.hardening,
           .saturation = law.saturation - law.yield,
           .saturation_exponent = law.exponent},
          dt};
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
