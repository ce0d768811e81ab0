#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/power_kernel.hpp"

namespace cnem::plasticity {

/// Linear hardening at any rate and temperature.
struct Linear {
  double yield = 0.0, hardening = 0.0;

  static constexpr const char* name = "linear";
  static constexpr const char* formula = "yield + hardening ε̄p";
  static constexpr const char* source = "";
  static constexpr Parameter<Linear> parameters[] = {
      {&Linear::yield,
       {.name = "yield",
        .unit = "Pa",
        .range = positive,
        .required = true,
        .meaning = "Yield stress.",
        .example = "400 MPa"}},
      {&Linear::hardening,
       {.name = "hardening",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Slope of the flow stress over plastic strain.",
        .example = "100 MPa"}}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Linear& law, N strain, N, T) {
  return T(law.yield) + T(law.hardening) * strain;
}

CNEM_INLINE PowerKernel<false> kernel_of(const Linear& law, double dt) {
  return {{.A = law.yield, .B = law.hardening}, dt};
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
