#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/johnson_cook.hpp"

namespace cnem::plasticity {

/// The law of Johnson and Cook with softening by strain, as by recrystallisation in the bands of saw-toothed
/// chips: Calamaz, Coupard and Girot (Int. J. Mach. Tools Manuf. 48, 2008), with 1/exp(ε̄p^a) in the hardening
/// and tanh(1/(ε̄p + S)^c); other variants are in print. Temperatures in D and S are absolute ones, T/Tmelt at
/// most 1; without a melting temperature tanh has no part in it.
struct Calamaz {
  static constexpr Range exponent{.low = 0.0, .high = 100.0, .low_open = true};

  double A = 0.0, B = 0.0, n = 1.0, a = 1.0, b = 1.0, c = 1.0, d = 1.0;
  double C = 0.0, rate0 = 1.0, m = 1.0, T0 = 293.15, Tmelt = infinite;

  static constexpr bool may_fall = true;
  static constexpr const char* name = "calamaz";
  static constexpr const char* formula =
      "[A + B ε̄pⁿ exp(−ε̄pᵃ)](1 + C ln(ε̄̇p/rate0))(1 − T*ᵐ)[D + (1 − D) tanh((ε̄p + S)⁻ᶜ)], D = 1 − "
      "(T/Tmelt)ᵈ, S = (T/Tmelt)ᵇ";
  static constexpr const char* source = "Calamaz, Coupard and Girot 2008";
  static constexpr Parameter<Calamaz> parameters[] = {
      {&Calamaz::A, JohnsonCook::parameters[0].info},
      {&Calamaz::B, JohnsonCook::parameters[1].info},
      {&Calamaz::n, JohnsonCook::parameters[2].info},
      {&Calamaz::a,
       {.name = "a",
        .range = exponent,
        .required = true,
        .meaning = "Exponent of the strain that ends the hardening; hardening passes its peak at ε̄pᵃ = n/a.",
        .example = "1.6"}},
      {&Calamaz::b,
       {.name = "b",
        .range = exponent,
        .required = true,
        .meaning = "Exponent of T/Tmelt that brings the softening to smaller strains.",
        .example = "0.4"}},
      {&Calamaz::c,
       {.name = "c",
        .range = exponent,
        .required = true,
        .meaning = "How steeply it softens where ε̄p + S is 1.",
        .example = "6"}},
      {&Calamaz::d,
       {.name = "d",
        .range = exponent,
        .required = true,
        .meaning = "Exponent of T/Tmelt, the share that softens.",
        .example = "1"}},
      {&Calamaz::C, JohnsonCook::parameters[3].info},
      {&Calamaz::rate0, JohnsonCook::parameters[4].info},
      {&Calamaz::m, JohnsonCook::parameters[5].info},
      {&Calamaz::T0, JohnsonCook::parameters[6].info},
      {&Calamaz::Tmelt, JohnsonCook::parameters[7].info}};
  static constexpr Order orders[] = {{"Tmelt", "T0"}};
  static constexpr const char* strength[] = {"A", "B"};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Calamaz& law, N strain, N rate, T temperature) {
  N hardened{T(law.A)};
  if (law.B > 0.0)
    hardened = hardened + T(law.B) * (power(strain, law.n) * exponential(T(-1.0) * power(strain, law.a)));
  if (law.Tmelt < infinite) {
    const T melting = min(temperature / T(law.Tmelt), T(1.0)), soft = power(melting, law.d);
    // tanh is 1 to rounding from 20 on
    const N start = at_least(power(melting, law.b) + strain, exp(log(20.0) * (-1.0 / law.c)));
    hardened = hardened * ((T(1.0) - soft) + soft * hyperbolic_tangent(power(start, -law.c)));
  }
  return at_rate_and_temperature(law, hardened, rate, temperature);
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
