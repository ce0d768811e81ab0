#pragma once
#include "core/parameter.hpp"
#include "plasticity/jet.hpp"

namespace cnem::plasticity {

/// Flow stress of Zerilli and Armstrong (J. Appl. Phys. 61, 1987, bcc form) for body-centred metals: iron,
/// ferritic and martensitic steels, tantalum. Heat and rate act on the yield stress alone, not on the
/// hardening, as dislocations cross barriers that their number does not change. Without a threshold in rate:
/// it tends to C0 + C5 ε̄pⁿ as the rate falls to zero. Fitted by its authors to 10⁻³ … 10⁴ /s and temperatures
/// well below the change of lattice (iron: 1185 K).
struct ZerilliArmstrongBcc {
  double C0 = 0.0, C1 = 0.0, C3 = 0.0, C4 = 0.0, C5 = 0.0, n = 1.0;

  static constexpr const char* name = "zerilli-armstrong-bcc";
  static constexpr const char* formula = "C0 + C1 exp(−C3 T + C4 T ln(ε̄̇p s)) + C5 ε̄pⁿ";
  static constexpr const char* source = "Zerilli and Armstrong 1987";
  static constexpr Parameter<ZerilliArmstrongBcc> parameters[] = {
      {&ZerilliArmstrongBcc::C0,
       {.name = "C0",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Athermal part: solutes and grain boundaries, Δσ_G + k/√(grain size).",
        .example = "65 MPa"}},
      {&ZerilliArmstrongBcc::C1,
       {.name = "C1",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Thermal part at 0 K.",
        .example = "1033 MPa"}},
      {&ZerilliArmstrongBcc::C3,
       {.name = "C3",
        .unit = "1/K",
        .range = not_negative,
        .required = true,
        .meaning = "Fall of the thermal part with temperature at 1 /s; of the hardening in fcc metals.",
        .example = "0.00698 /K"}},
      {&ZerilliArmstrongBcc::C4,
       {.name = "C4",
        .unit = "1/K",
        .range = not_negative,
        .required = true,
        .meaning = "Rate sensitivity of the same, over temperature.",
        .example = "0.000415 /K"}},
      {&ZerilliArmstrongBcc::C5,
       {.name = "C5",
        .unit = "Pa",
        .range = not_negative,
        .required = true,
        .meaning = "Hardening.",
        .example = "266 MPa"}},
      {&ZerilliArmstrongBcc::n,
       {.name = "n",
        .range = positive,
        .required = true,
        .meaning = "Hardening exponent.",
        .example = "0.289"}}};
  static constexpr const char* strength[] = {"C0", "C1", "C5"};
};

namespace CNEM_ISA {

template<class N, class T>
CNEM_INLINE N flow_stress(const ZerilliArmstrongBcc& law, N strain, N rate, T temperature) {
  const N hot = temperature * (T(law.C4) * logarithm(at_least(rate, 1e-300)) - T(law.C3));
  return T(law.C0) + T(law.C1) * exponential(hot) + T(law.C5) * power(strain, law.n);
}

} // namespace CNEM_ISA
} // namespace cnem::plasticity
