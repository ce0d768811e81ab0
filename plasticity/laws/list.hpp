#pragma once
// The hardening laws: a file each beside this one. A law is a struct of constants (core/parameter.hpp) with
//   flow_stress(law, strain, rate, temperature)   its formula, Pa, on numbers N of plasticity/jet.hpp and
//                                                 temperatures T, K; it falls neither with strain nor rate
// in namespace CNEM_ISA, and where formula and derivatives are too slow a kernel_of(law, dt) of its own.
#include "plasticity/laws/johnson_cook.hpp"
#include "plasticity/laws/linear.hpp"
#include "plasticity/laws/perfect.hpp"
#include "plasticity/laws/voce.hpp"
#include "plasticity/laws/zerilli_armstrong_bcc.hpp"

#include "plasticity/formula_kernel.hpp" // after the laws, whose formulas it calls

namespace cnem::plasticity {

using HardeningLaws = Laws<JohnsonCook, Linear, Perfect, Voce, ZerilliArmstrongBcc>;

} // namespace cnem::plasticity
