#pragma once
// What laws of damage are asked about. Vector kernels see this header too: no function definitions and no
// standard containers outside of CNEM_ISA.
#include "core/machine/simd.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Points that flow.
template<class T> struct Flowing {
  T triaxiality; ///< –    σ* = mean stress over σ_eq
  T equivalent;  ///< Pa   σ_eq > 0
  T largest;     ///< Pa   σ1, the largest principal stress; of laws that ask for it
  T rate;        ///< 1/s  dε̄p/dt > 0
  T temperature; ///< K
};

/// Laws of the largest principal stress: damage grows where it is tension.
template<class Law, class T>
requires(Law::of_largest_stress) CNEM_INLINE Mask<T> breaks(const Law&, const Flowing<T>& at) {
  return at.largest > T(0.0);
}

} // namespace cnem::plasticity::CNEM_ISA
