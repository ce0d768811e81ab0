#pragma once
// How kernels choose a law, once per range of points.
#include "core/machine/simd.hpp"
#include "core/parameter.hpp"

namespace cnem::plasticity::CNEM_ISA {

namespace { // each kernel file has its own, whose types nobody else sees

/// f(constants of the law at `index` of the list).
template<class First, class... Rest, class F>
auto with_law(Laws<First, Rest...>, int index, const void* constants, const F& f) {
  if constexpr (sizeof...(Rest) > 0)
    if (index > 0) return with_law(Laws<Rest...>{}, index - 1, constants, f);
  return f(*static_cast<const First*>(constants));
}

} // namespace

} // namespace cnem::plasticity::CNEM_ISA
