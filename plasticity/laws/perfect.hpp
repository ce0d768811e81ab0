#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/linear.hpp"
#include "plasticity/power_kernel.hpp"

namespace cnem::plasticity {

/// No hardening, at any rate and temperature.
struct Perfect {
  double yield = 0.0;

  static constexpr const char* name = "perfect";
  static constexpr const char* formula = "yield";
  static constexpr const char* source = "";
  static constexpr Parameter<Perfect> parameters[] = {{&Perfect::yield, Linear::parameters[0].info}};
};

namespace CNEM_ISA {

template<class N, class T> CNEM_INLINE N flow_stress(const Perfect& law, N, N, T) { return N{T(law.yield)}; }

CNEM_INLINE PowerKernel<false> kernel_of(const Perfect& law, double dt) { return {{.A = law.yield}, dt}; }

} // namespace CNEM_ISA
} // namespace cnem::plasticity
