#pragma once
// Numbers for kernels that are compiled once per instruction set (cmake/cnem.cmake, cnem_kernel): one
// template on the number type T runs with T = double and with T = Pack, as many doubles as a register holds.
//
// Everything lives in namespace CNEM_ISA, which differs per instruction set: an inline function of a common
// namespace, compiled here with AVX, could be the copy that the linker keeps for a machine without it. No
// standard library functions for the same reason. Elsewhere (CNEM_ISA not defined) there is only T = double.
#if defined(CNEM_ISA_baseline) || defined(CNEM_ISA_avx2) || defined(CNEM_ISA_avx512)
#define CNEM_PACK 1
#include <immintrin.h>
#else
#define CNEM_ISA generic
#endif

#define CNEM_INLINE [[gnu::always_inline]] inline

namespace cnem::CNEM_ISA {

using Bits = unsigned long long;

// --- T = double ---

template<class T> struct Number;

template<> struct Number<double> {
  using Mask = bool;
  using Bits = ::cnem::CNEM_ISA::Bits;
  static constexpr int width = 1;
};

CNEM_INLINE Bits to_bits(double x) { return __builtin_bit_cast(Bits, x); }
CNEM_INLINE double from_bits(Bits x) { return __builtin_bit_cast(double, x); }
CNEM_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
CNEM_INLINE bool any(bool mask) { return mask; }
CNEM_INLINE bool lane(bool mask, int) { return mask; }
CNEM_INLINE double sqrt(double x) { return __builtin_sqrt(x); }
CNEM_INLINE void store(double* p, double x) { *p = x; }

// --- T = Pack ---

#ifdef CNEM_PACK

#if defined(CNEM_ISA_avx512)
inline constexpr int pack_width = 8;
#elif defined(CNEM_ISA_avx2)
inline constexpr int pack_width = 4;
#else
inline constexpr int pack_width = 2;
#endif

using DoubleVector [[gnu::vector_size(8 * pack_width)]] = double;
using UnalignedVector [[gnu::vector_size(8 * pack_width), gnu::aligned(8), gnu::may_alias]] = double;
using BitsVector [[gnu::vector_size(8 * pack_width)]] = Bits;
using MaskVector [[gnu::vector_size(8 * pack_width)]] = long long;

CNEM_INLINE DoubleVector broadcast(double x) {
#if defined(CNEM_ISA_avx512)
  return DoubleVector{x, x, x, x, x, x, x, x};
#elif defined(CNEM_ISA_avx2)
  return DoubleVector{x, x, x, x};
#else
  return DoubleVector{x, x};
#endif
}

struct PackBits {
  BitsVector v;
};

/// True or false per lane.
struct PackMask {
  MaskVector v;
  CNEM_INLINE friend PackMask operator&(PackMask a, PackMask b) { return {a.v & b.v}; }
  CNEM_INLINE friend PackMask operator|(PackMask a, PackMask b) { return {a.v | b.v}; }
  CNEM_INLINE friend PackMask operator!(PackMask a) { return {~a.v}; }
};

struct Pack {
  DoubleVector v;

  Pack() = default;
  CNEM_INLINE Pack(DoubleVector x) : v(x) {}
  CNEM_INLINE Pack(double x) : v(broadcast(x)) {}

  CNEM_INLINE friend Pack operator+(Pack a, Pack b) { return a.v + b.v; }
  CNEM_INLINE friend Pack operator-(Pack a, Pack b) { return a.v - b.v; }
  CNEM_INLINE friend Pack operator*(Pack a, Pack b) { return a.v * b.v; }
  CNEM_INLINE friend Pack operator/(Pack a, Pack b) { return a.v / b.v; }
  CNEM_INLINE friend Pack operator-(Pack a) { return -a.v; }
  CNEM_INLINE friend PackMask operator<(Pack a, Pack b) { return {a.v < b.v}; }
  CNEM_INLINE friend PackMask operator>(Pack a, Pack b) { return {a.v > b.v}; }
  CNEM_INLINE friend PackMask operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  CNEM_INLINE friend PackMask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
};

CNEM_INLINE PackBits operator+(PackBits a, Bits b) { return {a.v + b}; }
CNEM_INLINE PackBits operator+(PackBits a, PackBits b) { return {a.v + b.v}; }
CNEM_INLINE PackBits operator&(PackBits a, Bits b) { return {a.v & b}; }
CNEM_INLINE PackBits operator|(PackBits a, Bits b) { return {a.v | b}; }
CNEM_INLINE PackBits operator<<(PackBits a, int b) { return {a.v << b}; }
CNEM_INLINE PackBits operator>>(PackBits a, int b) { return {a.v >> b}; }

template<> struct Number<Pack> {
  using Mask = PackMask;
  using Bits = PackBits;
  static constexpr int width = pack_width;
};

CNEM_INLINE PackBits to_bits(Pack x) { return {(BitsVector)x.v}; }
CNEM_INLINE Pack from_bits(PackBits x) { return (DoubleVector)x.v; }
CNEM_INLINE Pack select(PackMask mask, Pack a, Pack b) { return mask.v ? a.v : b.v; }
CNEM_INLINE bool lane(PackMask mask, int k) { return mask.v[k] != 0; }
CNEM_INLINE void store(double* p, Pack x) { *reinterpret_cast<UnalignedVector*>(p) = x.v; }

CNEM_INLINE bool any(PackMask mask) {
#if defined(CNEM_ISA_avx512)
  return _mm512_movepi64_mask((__m512i)mask.v) != 0;
#elif defined(CNEM_ISA_avx2)
  return _mm256_movemask_pd((__m256d)mask.v) != 0;
#else
  return _mm_movemask_pd((__m128d)mask.v) != 0;
#endif
}

CNEM_INLINE Pack sqrt(Pack x) {
#if defined(CNEM_ISA_avx512)
  return (DoubleVector)_mm512_maskz_sqrt_pd(0xff, (__m512d)x.v);
#elif defined(CNEM_ISA_avx2)
  return (DoubleVector)_mm256_sqrt_pd((__m256d)x.v);
#else
  return (DoubleVector)_mm_sqrt_pd((__m128d)x.v);
#endif
}

#endif // CNEM_PACK

// --- either ---

template<class T> using Mask = typename Number<T>::Mask;

template<class T> CNEM_INLINE T load(const double* p) {
  if constexpr (Number<T>::width == 1) return *p;
#ifdef CNEM_PACK
  else
    return T(DoubleVector(*reinterpret_cast<const UnalignedVector*>(p)));
#endif
}

/// The larger; b where a is NaN.
template<class T> CNEM_INLINE T max(T a, T b) { return select(a > b, a, b); }
/// The smaller; b where a is NaN.
template<class T> CNEM_INLINE T min(T a, T b) { return select(a < b, a, b); }
template<class T> CNEM_INLINE T abs(T x) { return from_bits(to_bits(x) & ~(Bits(1) << 63)); }

/// Σ c_k x^k by Horner's rule.
template<class T, int n> CNEM_INLINE T polynomial(T x, const double (&c)[n]) {
  T sum = T(c[n - 1]);
  for (int k = n - 2; k >= 0; --k) sum = sum * x + T(c[k]);
  return sum;
}

inline constexpr double ln2_high = 0x1.62e42p-1; ///< 20 bits, so that its products with exponents are exact
inline constexpr double ln2_low = 0x1.fdf473de6af28p-22;

/// ln x for positive normal x, to 1 ulp; ≤ −708 for zero and subnormal x, meaningless for negative x.
///
/// x = 2^k m, m in [√½, √2); with f = m − 1 and s = f/(2 + f): ln m = 2s + s³ q(s²) = f − s (f − s² q), where
/// q is the minimax fit of degree 6 (relative error of ln m 1.3e-18).
template<class T> CNEM_INLINE T log(T x) {
  constexpr double q[] = {0x1.5555555555592p-1, 0x1.999999997fde0p-2, 0x1.24924941ef442p-2,
                          0x1.c71c520aafe6ap-3, 0x1.74663eaa73b2bp-3, 0x1.39a1c06527908p-3,
                          0x1.2f052ec134cc6p-3};
  constexpr Bits root_half = 0x3fe6a09e00000000, one = 0x3ff0000000000000, mantissa = 0x000fffffffffffff;
  constexpr Bits two52 = 0x4330000000000000;
  const auto shifted = to_bits(x) + (one - root_half);
  const T k = from_bits((shifted >> 52) | two52) - T(0x1p52 + 1023.0);
  const T f = from_bits((shifted & mantissa) + root_half) - T(1.0);
  const T s = f / (f + T(2.0));
  const T z = s * s;
  return k * T(ln2_high) + (f - (s * (f - z * polynomial(z, q)) - k * T(ln2_low)));
}

/// e^x to 1 ulp; clamped to the normal range, so that x < −708 gives about 3e-308 and x > 709 about 8e307.
///
/// x = n ln 2 + r, e^r = 1 + r + r² q(r), q the minimax fit of degree 9 (error 3.5e-18).
template<class T> CNEM_INLINE T exp(T x) {
  constexpr double q[] = {0.5000000000000012,     0.166666666666667,     0.04166666666651542,
                          0.008333333333307203,   0.0013888888947016797, 0.00019841269917388645,
                          2.4801489941433627e-05, 2.75572162956521e-06,  2.7631280580566606e-07,
                          2.511786284311365e-08};
  constexpr double round = 0x1.8p52; // adding it leaves the nearest integer in the low bits
  const T y = min(max(x, T(-708.0)), T(709.0));
  const T shifted = y * T(0x1.71547652b82fep+0) + T(round);
  const T n = shifted - T(round);
  const T r = (y - n * T(ln2_high)) - n * T(ln2_low);
  const T e = T(1.0) + (r + r * r * polynomial(r, q));
  return from_bits(to_bits(e) + (to_bits(shifted) << 52));
}

/// x^p for x ≥ 0 and p > 0; 0 at x = 0.
template<class T> CNEM_INLINE T pow(T x, T p) { return select(x > T(0.0), exp(p * log(x)), T(0.0)); }

} // namespace cnem::CNEM_ISA
