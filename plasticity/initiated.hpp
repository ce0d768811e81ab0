#pragma once
// Where softening is initiated, for kernels and for what is around them.
#include "core/machine/simd.hpp"

namespace cnem::plasticity::CNEM_ISA {

/// Whether ω grows with flow: where D + ω ≥ 1, which is D = 1 for matter that is not mixed. A point that
/// resampling mixed of broken and sound matter has the means of both; D alone is below 1 there however
/// little of it is sound.
template<class T> CNEM_INLINE auto initiated(T damage, T softening) { return damage + softening >= T(1.0); }

} // namespace cnem::plasticity::CNEM_ISA
