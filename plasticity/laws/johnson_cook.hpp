#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/power_kernel.hpp"

namespace cnem::plasticity {

/// Flow stress of Johnson and Cook (1983), paper 004 (64), in Kirchhoff measure. Without a melting
/// temperature there is no thermal softening.
struct JohnsonCook {
  double A = 0.0, B = 0.0, n = 1.0, C = 0.0, rate0 = 1.0, m = 1.0, T0 = 293.15, Tmelt = infinite;

  static constexpr const char* name = "johnson-cook";
  static constexpr const char* formula =
      "(A + B ε̄pⁿ)(1 + C ln(ε̄̇p/rate0))(1 − T*ᵐ), T* = (T − T0)/(Tmelt − T0) clipped to [0, 1]";
  static constexpr const char* source = "Johnson and Cook 1983";
  static constexpr Parameter<JohnsonCook> parameters[] = {
      {&JohnsonCook::A,
       {.name = "A", .unit = "Pa", .range = not_negative, .required = true, .meaning = "Yield stress."}},
      {&JohnsonCook::B,
       {.name = "B",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Hardening.",
        .example = "685 MPa"}},
      {&JohnsonCook::n,
       {.name = "n",
        .range = positive,
        .required = true,
        .meaning = "Hardening exponent.",
        .example = "0.312"}},
      {&JohnsonCook::C,
       {.name = "C", .range = not_negative, .meaning = "Rate sensitivity; none below `rate0`."}},
      {&JohnsonCook::rate0,
       {.name = "rate0", .unit = "1/s", .range = positive, .meaning = "Reference strain rate."}},
      {&JohnsonCook::m, {.name = "m", .range = positive, .meaning = "Exponent of thermal softening."}},
      {&JohnsonCook::T0,
       {.name = "T0",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Temperature below which nothing softens."}},
      {&JohnsonCook::Tmelt,
       {.name = "Tmelt",
        .unit = "K",
        .range = temperature_range,
        .meaning = "Melting temperature; without it there is no thermal softening.",
        .example = "1698 K"}}};
  static constexpr Order orders[] = {{"Tmelt", "T0"}};
  static constexpr const char* strength[] = {"A", "B"};
};

namespace CNEM_ISA {

/// The factors of rate and temperature on a flow stress, of any law with these constants.
template<class Law, class N, class T>
CNEM_INLINE N at_rate_and_temperature(const Law& law, N hardened, N rate, T temperature) {
  const T homologous = min(max((temperature - law.T0) / T(law.Tmelt - law.T0), T(0.0)), T(1.0));
  return hardened * (T(1.0) + T(law.C) * logarithm(at_least(rate / T(law.rate0), 1.0))) *
         (T(1.0) - power(homologous, law.m));
}

template<class N, class T>
CNEM_INLINE N flow_stress(const JohnsonCook& law, N strain, N rate, T temperature) {
  N hardened{T(law.A)};
  if (law.B > 0.0) hardened = hardened + T(law.B) * power(strain, law.n);
  return at_rate_and_temperature(law, hardened, rate, temperature);
}

CNEM_INLINE PowerKernel<false> kernel_of(const JohnsonCook& law, double dt) {
  return {{.A = law.A,
           .B = law.B,
           .n = law.n,
           .C = law.C,
           .rate0 = law.rate0,
           .m = law.m,
           .T0 = law.T0,
           .Tmelt = law.Tmelt},
          dt};
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
