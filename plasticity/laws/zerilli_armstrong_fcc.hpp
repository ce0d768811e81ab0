#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"
#include "plasticity/laws/zerilli_armstrong_bcc.hpp"

namespace cnem::plasticity {

/// Flow stress of Zerilli and Armstrong (J. Appl. Phys. 61, 1987, fcc form) for face-centred metals: copper,
/// aluminium, nickel, austenitic steels. Heat and rate act on the hardening, as dislocations cross each
/// other, and not on the yield stress. Without a threshold in rate: it tends to C0 as the rate falls to zero.
struct ZerilliArmstrongFcc {
  double C0 = 0.0, C2 = 0.0, C3 = 0.0, C4 = 0.0, strain_exponent = 0.5;

  static constexpr const char* name = "zerilli-armstrong-fcc";
  static constexpr const char* formula = "C0 + C2 ε̄p^strain_exponent exp(−C3 T + C4 T ln(ε̄̇p s))";
  static constexpr const char* source = "Zerilli and Armstrong 1987";
  static constexpr Parameter<ZerilliArmstrongFcc> parameters[] = {
      {&ZerilliArmstrongFcc::C0, ZerilliArmstrongBcc::parameters[0].info},
      {&ZerilliArmstrongFcc::C2,
       {.name = "C2",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Hardening at 0 K.",
        .example = "890 MPa"}},
      {&ZerilliArmstrongFcc::C3, ZerilliArmstrongBcc::parameters[2].info},
      {&ZerilliArmstrongFcc::C4, ZerilliArmstrongBcc::parameters[3].info},
      {&ZerilliArmstrongFcc::strain_exponent,
       {.name = "strain_exponent",
        .range = positive,
        .meaning = "Hardening exponent; its authors' is 1/2."}}};
  static constexpr const char* strength[] = {"C0", "C2"};
};

namespace CNEM_ISA {

template<class N, class T>
CNEM_INLINE N flow_stress(const ZerilliArmstrongFcc& law, N strain, N rate, T temperature) {
  const N hot = temperature * (T(law.C4) * logarithm(at_least(rate, 1e-300)) - T(law.C3));
  return T(law.C0) + T(law.C2) * (power(strain, law.strain_exponent) * exponential(hot));
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
