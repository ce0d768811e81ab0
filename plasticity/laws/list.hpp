#pragma once
// The hardening laws: a file each beside this one. A law is a struct of constants (core/parameter.hpp) with
//   flow_stress(law, strain, rate, temperature)   its formula, Pa, on numbers N of plasticity/jet.hpp and
//                                                 temperatures T, K; it does not fall with rate
//   may_fall                                      optional, true: it may fall with strain, by less than 3μ
// in namespace CNEM_ISA, and where formula and derivatives are too slow a kernel_of(law, dt) of its own.
#include "plasticity/laws/calamaz.hpp"
#include "plasticity/laws/goijaerts.hpp"
#include "plasticity/laws/hockett_sherby.hpp"
#include "plasticity/laws/johnson_cook.hpp"
#include "plasticity/laws/linear.hpp"
#include "plasticity/laws/perfect.hpp"
#include "plasticity/laws/swift.hpp"
#include "plasticity/laws/tabulated.hpp"
#include "plasticity/laws/voce.hpp"
#include "plasticity/laws/zerilli_armstrong_bcc.hpp"
#include "plasticity/laws/zerilli_armstrong_fcc.hpp"

#include "plasticity/formula_kernel.hpp" // after the laws, whose formulas it calls

namespace cnem::plasticity {

using HardeningLaws = Laws<JohnsonCook, Linear, Perfect, Voce, ZerilliArmstrongBcc, ZerilliArmstrongFcc,
                           Swift, HockettSherby, Goijaerts, Calamaz, Tabulated>;

} // namespace cnem::plasticity
