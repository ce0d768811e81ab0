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
/// One copy of the instructions for all callers: a copy for a constant argument may round in another way.
#ifdef __clang__
#define CNEM_ONE_COPY [[gnu::noinline]]
#else
#define CNEM_ONE_COPY [[gnu::noinline, gnu::noclone]]
#endif

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
/// The larger; b where either is NaN.
CNEM_INLINE double max(double a, double b) { return a > b ? a : b; }
/// The smaller; b where either is NaN.
CNEM_INLINE double min(double a, double b) { return a < b ? a : b; }
CNEM_INLINE void store(double* p, double x) { *p = x; }

// --- T = Pack ---

#ifdef CNEM_PACK

#if defined(CNEM_ISA_avx512)
inline constexpr int register_width = 8;
#elif defined(CNEM_ISA_avx2)
inline constexpr int register_width = 4;
#else
inline constexpr int register_width = 2;
#endif

using DoubleVector [[gnu::vector_size(8 * register_width)]] = double;
using UnalignedVector [[gnu::vector_size(8 * register_width), gnu::aligned(8), gnu::may_alias]] = double;
using BitsVector [[gnu::vector_size(8 * register_width)]] = Bits;
using MaskVector [[gnu::vector_size(8 * register_width)]] = long long;

// GCC makes single instructions of these only from intrinsics.
#if defined(CNEM_ISA_avx512)
CNEM_INLINE DoubleVector broadcast(double x) { return DoubleVector{x, x, x, x, x, x, x, x}; }
CNEM_INLINE DoubleVector maximum(DoubleVector a, DoubleVector b) { return _mm512_maskz_max_pd(0xff, a, b); }
CNEM_INLINE DoubleVector minimum(DoubleVector a, DoubleVector b) { return _mm512_maskz_min_pd(0xff, a, b); }
CNEM_INLINE DoubleVector square_root(DoubleVector x) { return _mm512_maskz_sqrt_pd(0xff, x); }
CNEM_INLINE bool any_negative(MaskVector m) { return _mm512_movepi64_mask((__m512i)m) != 0; }
#elif defined(CNEM_ISA_avx2)
CNEM_INLINE DoubleVector broadcast(double x) { return DoubleVector{x, x, x, x}; }
CNEM_INLINE DoubleVector maximum(DoubleVector a, DoubleVector b) { return _mm256_max_pd(a, b); }
CNEM_INLINE DoubleVector minimum(DoubleVector a, DoubleVector b) { return _mm256_min_pd(a, b); }
CNEM_INLINE DoubleVector square_root(DoubleVector x) { return _mm256_sqrt_pd(x); }
CNEM_INLINE bool any_negative(MaskVector m) { return _mm256_movemask_pd((__m256d)m) != 0; }
#else
CNEM_INLINE DoubleVector broadcast(double x) { return DoubleVector{x, x}; }
CNEM_INLINE DoubleVector maximum(DoubleVector a, DoubleVector b) { return _mm_max_pd(a, b); }
CNEM_INLINE DoubleVector minimum(DoubleVector a, DoubleVector b) { return _mm_min_pd(a, b); }
CNEM_INLINE DoubleVector square_root(DoubleVector x) { return _mm_sqrt_pd(x); }
CNEM_INLINE bool any_negative(MaskVector m) { return _mm_movemask_pd((__m128d)m) != 0; }
#endif

/// a0 b0 a2 b2 … and a1 b1 a3 b3 …
#if defined(CNEM_ISA_avx512)
CNEM_INLINE DoubleVector even_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
}
CNEM_INLINE DoubleVector odd_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}
#elif defined(CNEM_ISA_avx2)
CNEM_INLINE DoubleVector even_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 0, 4, 2, 6);
}
CNEM_INLINE DoubleVector odd_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 1, 5, 3, 7);
}
#else
CNEM_INLINE DoubleVector even_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 0, 2);
}
CNEM_INLINE DoubleVector odd_pairs(DoubleVector a, DoubleVector b) {
  return __builtin_shufflevector(a, b, 1, 3);
}
#endif

/// One number of each of four vectors side by side at p, those of the next lane `stride` numbers further.
template<int stride>
CNEM_INLINE void store_fours(DoubleVector a, DoubleVector b, DoubleVector c, DoubleVector d, double* p) {
  using Four [[gnu::vector_size(32)]] = double;
  using Unaligned [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
  const DoubleVector even[2] = {even_pairs(a, b), even_pairs(c, d)},
                     odd[2] = {odd_pairs(a, b), odd_pairs(c, d)};
  const auto put = [p](int lane, Four x) { *reinterpret_cast<Unaligned*>(p + stride * lane) = x; };
#if defined(CNEM_ISA_avx512)
  const auto low = [](DoubleVector x, DoubleVector y) {
    return __builtin_shufflevector(x, y, 0, 1, 8, 9, 4, 5, 12, 13);
  };
  const auto high = [](DoubleVector x, DoubleVector y) {
    return __builtin_shufflevector(x, y, 2, 3, 10, 11, 6, 7, 14, 15);
  };
  const auto put_both = [put](int lane, DoubleVector x) {
    put(lane, __builtin_shufflevector(x, x, 0, 1, 2, 3));
    put(lane + 4, __builtin_shufflevector(x, x, 4, 5, 6, 7));
  };
  put_both(0, low(even[0], even[1]));
  put_both(1, low(odd[0], odd[1]));
  put_both(2, high(even[0], even[1]));
  put_both(3, high(odd[0], odd[1]));
#elif defined(CNEM_ISA_avx2)
  put(0, __builtin_shufflevector(even[0], even[1], 0, 1, 4, 5));
  put(1, __builtin_shufflevector(odd[0], odd[1], 0, 1, 4, 5));
  put(2, __builtin_shufflevector(even[0], even[1], 2, 3, 6, 7));
  put(3, __builtin_shufflevector(odd[0], odd[1], 2, 3, 6, 7));
#else
  put(0, __builtin_shufflevector(even[0], even[1], 0, 1, 2, 3));
  put(1, __builtin_shufflevector(odd[0], odd[1], 0, 1, 2, 3));
#endif
}

// Written out, not as a loop: the compiler takes packs apart into registers before it unrolls, and code that
// waits for that may stay in memory.
#define CNEM_EACH(...)                                                                                       \
  static_assert(n == 1 || n == 2);                                                                           \
  {                                                                                                          \
    constexpr int k = 0;                                                                                     \
    __VA_ARGS__;                                                                                             \
  }                                                                                                          \
  if constexpr (n == 2) {                                                                                    \
    constexpr int k = 1;                                                                                     \
    __VA_ARGS__;                                                                                             \
  }
// NOLINTBEGIN(bugprone-macro-parentheses): types cannot stand in parentheses
#define CNEM_OPERATOR(Result, A, B, op, right)                                                               \
  CNEM_INLINE friend Result operator op(A a, B b) {                                                          \
    Result r;                                                                                                \
    CNEM_EACH(r.v[k] = a.v[k] op right);                                                                     \
    return r;                                                                                                \
  }
// NOLINTEND(bugprone-macro-parentheses)

template<int n> struct PackBits {
  BitsVector v[n];

  CNEM_OPERATOR(PackBits, PackBits, PackBits, +, b.v[k])
  CNEM_OPERATOR(PackBits, PackBits, Bits, +, b)
  CNEM_OPERATOR(PackBits, PackBits, Bits, &, b)
  CNEM_OPERATOR(PackBits, PackBits, Bits, |, b)
  CNEM_OPERATOR(PackBits, PackBits, int, <<, b)
  CNEM_OPERATOR(PackBits, PackBits, int, >>, b)
};

/// True or false per lane.
template<int n> struct PackMask {
  MaskVector v[n];

  CNEM_OPERATOR(PackMask, PackMask, PackMask, &, b.v[k])
  CNEM_OPERATOR(PackMask, PackMask, PackMask, |, b.v[k])
  CNEM_INLINE friend PackMask operator!(PackMask a) {
    CNEM_EACH(a.v[k] = ~a.v[k]);
    return a;
  }
};

/// n registers of doubles: with n = 2 two independent chains of operations hide each other's latency.
template<int n> struct Pack {
  DoubleVector v[n];

  Pack() = default;
  CNEM_INLINE Pack(double x) { CNEM_EACH(v[k] = broadcast(x)); }

  CNEM_OPERATOR(Pack, Pack, Pack, +, b.v[k])
  CNEM_OPERATOR(Pack, Pack, Pack, -, b.v[k])
  CNEM_OPERATOR(Pack, Pack, Pack, *, b.v[k])
  CNEM_OPERATOR(Pack, Pack, Pack, /, b.v[k])
  CNEM_OPERATOR(PackMask<n>, Pack, Pack, <, b.v[k])
  CNEM_OPERATOR(PackMask<n>, Pack, Pack, >, b.v[k])
  CNEM_OPERATOR(PackMask<n>, Pack, Pack, <=, b.v[k])
  CNEM_OPERATOR(PackMask<n>, Pack, Pack, >=, b.v[k])
  CNEM_INLINE friend Pack operator-(Pack a) {
    CNEM_EACH(a.v[k] = -a.v[k]);
    return a;
  }
};

template<int n> struct Number<Pack<n>> {
  using Mask = PackMask<n>;
  static constexpr int width = n * register_width;
};

template<int n> CNEM_INLINE PackBits<n> to_bits(Pack<n> x) {
  PackBits<n> r;
  CNEM_EACH(r.v[k] = (BitsVector)x.v[k]);
  return r;
}
template<int n> CNEM_INLINE Pack<n> from_bits(PackBits<n> x) {
  Pack<n> r;
  CNEM_EACH(r.v[k] = (DoubleVector)x.v[k]);
  return r;
}
template<int n> CNEM_INLINE Pack<n> select(PackMask<n> mask, Pack<n> a, Pack<n> b) {
  CNEM_EACH(b.v[k] = mask.v[k] ? a.v[k] : b.v[k]);
  return b;
}
template<int n> CNEM_INLINE bool lane(PackMask<n> mask, int i) {
  return mask.v[i / register_width][i % register_width] != 0;
}
template<int n> CNEM_INLINE void store(double* p, Pack<n> x) {
  CNEM_EACH(*reinterpret_cast<UnalignedVector*>(p + k * register_width) = x.v[k]);
}

template<int n> CNEM_INLINE bool any(PackMask<n> mask) {
  if constexpr (n == 1)
    return any_negative(mask.v[0]);
  else
    return any_negative(mask.v[0] | mask.v[1]);
}

template<int n> CNEM_INLINE Pack<n> max(Pack<n> a, Pack<n> b) {
  CNEM_EACH(a.v[k] = maximum(a.v[k], b.v[k]));
  return a;
}
template<int n> CNEM_INLINE Pack<n> min(Pack<n> a, Pack<n> b) {
  CNEM_EACH(a.v[k] = minimum(a.v[k], b.v[k]));
  return a;
}
template<int n> CNEM_INLINE Pack<n> sqrt(Pack<n> x) {
  CNEM_EACH(x.v[k] = square_root(x.v[k]));
  return x;
}

#undef CNEM_OPERATOR
#endif // CNEM_PACK

// --- either ---

template<class T> using Mask = typename Number<T>::Mask;

#ifdef CNEM_PACK
template<int n> CNEM_INLINE void load(const double* p, Pack<n>& x) {
  CNEM_EACH(x.v[k] = *reinterpret_cast<const UnalignedVector*>(p + k * register_width));
}
#undef CNEM_EACH
#endif
CNEM_INLINE void load(const double* p, double& x) { x = *p; }
template<class T> CNEM_INLINE T load(const double* p) {
  T x;
  load(p, x);
  return x;
}

template<class T> CNEM_INLINE T abs(T x) { return from_bits(to_bits(x) & ~(Bits(1) << 63)); }

/// Σ c_k x^k by Horner's rule.
template<class T, int n> CNEM_INLINE T polynomial(T x, const double (&c)[n]) {
  T sum = T(c[n - 1]);
  for (int k = n - 2; k >= 0; --k) sum = sum * x + T(c[k]);
  return sum;
}

inline constexpr double ln2_high = 0x1.62e42p-1; ///< 20 bits, so that its products with exponents are exact
inline constexpr double ln2_low = 0x1.fdf473de6af28p-22;

/// 1/x of every entry with one division; the product of all must stay in the normal range.
template<class T, int n> CNEM_INLINE void reciprocals(const T (&x)[n], T (&inverse)[n]) {
  T before[n]; // product of the entries before k
  before[0] = T(1.0);
  for (int k = 1; k < n; ++k) before[k] = k == 1 ? x[0] : before[k - 1] * x[k - 1];
  T rest = T(1.0) / (n == 1 ? x[0] : before[n - 1] * x[n - 1]);
  for (int k = n - 1; k > 0; --k) {
    inverse[k] = rest * before[k];
    rest = rest * x[k];
  }
  inverse[0] = rest;
}

/// ln x of every entry, for positive normal x, to 1 ulp; ≤ −708 for zero and subnormal x, meaningless for
/// negative x. One division for all.
///
/// x = 2^k m, m in [√½, √2); with f = m − 1 and s = f/(2 + f): ln m = 2s + s³ q(s²) = f − s (f − s² q), where
/// q is the minimax fit of degree 6 (relative error of ln m 1.3e-18).
template<class T, int n> CNEM_INLINE void logarithms(const T (&x)[n], T (&result)[n]) {
  constexpr double q[] = {0x1.5555555555592p-1, 0x1.999999997fde0p-2, 0x1.24924941ef442p-2,
                          0x1.c71c520aafe6ap-3, 0x1.74663eaa73b2bp-3, 0x1.39a1c06527908p-3,
                          0x1.2f052ec134cc6p-3};
  constexpr Bits root_half = 0x3fe6a09e00000000, one = 0x3ff0000000000000, mantissa = 0x000fffffffffffff;
  constexpr Bits two52 = 0x4330000000000000;
  T exponent[n], f[n], sum[n], inverse[n];
  for (int k = 0; k < n; ++k) {
    const auto shifted = to_bits(x[k]) + (one - root_half);
    exponent[k] = from_bits((shifted >> 52) | two52) - T(0x1p52 + 1023.0);
    f[k] = from_bits((shifted & mantissa) + root_half) - T(1.0);
    sum[k] = f[k] + T(2.0);
  }
  reciprocals(sum, inverse);
  for (int k = 0; k < n; ++k) {
    const T s = f[k] * inverse[k];
    const T z = s * s;
    result[k] =
        exponent[k] * T(ln2_high) + (f[k] - (s * (f[k] - z * polynomial(z, q)) - exponent[k] * T(ln2_low)));
  }
}

template<class T> CNEM_INLINE T log(T x) {
  T result[1];
  logarithms({x}, result);
  return result[0];
}

/// e^x to 1 ulp for −708 ≤ x ≤ 709; meaningless beyond.
///
/// x = n ln 2 + r, e^r = 1 + r + r² q(r), q the minimax fit of degree 9 (error 3.5e-18).
template<class T> CNEM_INLINE T exp(T x) {
  constexpr double q[] = {0.5000000000000012,     0.166666666666667,     0.04166666666651542,
                          0.008333333333307203,   0.0013888888947016797, 0.00019841269917388645,
                          2.4801489941433627e-05, 2.75572162956521e-06,  2.7631280580566606e-07,
                          2.511786284311365e-08};
  constexpr double round = 0x1.8p52; // adding it leaves the nearest integer in the low bits
  const T shifted = x * T(0x1.71547652b82fep+0) + T(round);
  const T n = shifted - T(round);
  const T r = (x - n * T(ln2_high)) - n * T(ln2_low);
  const T e = T(1.0) + (r + r * r * polynomial(r, q));
  return from_bits(to_bits(e) + (to_bits(shifted) << 52));
}

} // namespace cnem::CNEM_ISA
