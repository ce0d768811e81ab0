#pragma once
// A position, force or column of a tensor inside kernels: in the plane two doubles side by side, one 16-byte
// register of any x86-64, in space three and a fourth that means nothing, 32 bytes. For kernel files only
// (core/machine/simd.hpp says why nothing common may be used there).
#include "core/machine/simd.hpp"

#include <cstddef>

namespace cnem::CNEM_ISA {

template<int dim> struct Small;

template<> struct Small<2> {
  using Register [[gnu::vector_size(16)]] = double;
  using Unaligned [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;
  Register v;

  CNEM_INLINE static Small zero() { return {Register{0.0, 0.0}}; }
  CNEM_INLINE static Small of(double x, double y) { return {Register{x, y}}; }
  CNEM_INLINE static Small load(const double* p) { return {*reinterpret_cast<const Unaligned*>(p)}; }
  CNEM_INLINE void store(double* p) const { *reinterpret_cast<Unaligned*>(p) = v; }
  CNEM_INLINE double operator[](int k) const { return v[k]; }
  CNEM_INLINE Small& operator+=(Small b) { return v += b.v, *this; }
  CNEM_INLINE Small& operator-=(Small b) { return v -= b.v, *this; }
  CNEM_INLINE friend Small operator+(Small a, Small b) { return {a.v + b.v}; }
  CNEM_INLINE friend Small operator-(Small a, Small b) { return {a.v - b.v}; }
  CNEM_INLINE friend Small operator*(Small a, double s) { return {a.v * Register{s, s}}; }
  CNEM_INLINE friend Small operator*(Small a, Small b) { return {a.v * b.v}; } ///< component by component
  CNEM_INLINE friend Small swapped(Small a) { return {__builtin_shufflevector(a.v, a.v, 1, 0)}; }
  CNEM_INLINE friend Small first(Small a) { return {__builtin_shufflevector(a.v, a.v, 0, 0)}; }
  /// Of the components of each.
  CNEM_INLINE friend Small sums(Small a, Small b) {
    return {__builtin_shufflevector(a.v, b.v, 0, 2) + __builtin_shufflevector(a.v, b.v, 1, 3)};
  }
  CNEM_INLINE friend Small square_roots(Small a) { return of(sqrt(a.v[0]), sqrt(a.v[1])); }
  CNEM_INLINE double dot(Small b) const {
    const Register product = v * b.v;
    return product[0] + product[1];
  }
};

template<> struct Small<3> {
  using Register [[gnu::vector_size(32)]] = double;
  using Unaligned [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;
  Register v;

  CNEM_INLINE static Small zero() { return {Register{}}; }
  CNEM_INLINE static Small of(double x, double y, double z) { return {Register{x, y, z, 0.0}}; }
  /// Reads four doubles, and writes as many.
  CNEM_INLINE static Small load(const double* p) { return {*reinterpret_cast<const Unaligned*>(p)}; }
  CNEM_INLINE void store(double* p) const { *reinterpret_cast<Unaligned*>(p) = v; }
  CNEM_INLINE double operator[](int k) const { return v[k]; }
  CNEM_INLINE Small& operator+=(Small b) { return v += b.v, *this; }
  CNEM_INLINE Small& operator-=(Small b) { return v -= b.v, *this; }
  CNEM_INLINE friend Small operator+(Small a, Small b) { return {a.v + b.v}; }
  CNEM_INLINE friend Small operator-(Small a, Small b) { return {a.v - b.v}; }
  CNEM_INLINE friend Small operator*(Small a, double s) { return {a.v * Register{s, s, s, s}}; }
  CNEM_INLINE friend Small operator*(Small a, Small b) { return {a.v * b.v}; } ///< component by component
  /// The component k everywhere.
  template<int k> CNEM_INLINE Small all() const { return {__builtin_shufflevector(v, v, k, k, k, k)}; }
  CNEM_INLINE friend double component_sum(Small a) { return a[0] + a[1] + a[2]; }
  /// Of each.
  CNEM_INLINE friend Small<2> component_sums(Small a, Small b) {
    using Pair = Small<2>::Register;
    const Pair z = __builtin_shufflevector(a.v, b.v, 2, 6);
    return {(__builtin_shufflevector(a.v, b.v, 0, 4) + __builtin_shufflevector(a.v, b.v, 1, 5)) + z};
  }
  /// The first, second and third components of four, as four numbers each.
  CNEM_INLINE friend void components(Small a, Small b, Small c, Small d, Small (&x)[3]) {
    const Register low[2] = {__builtin_shufflevector(a.v, b.v, 0, 4, 2, 6),
                             __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6)},
                   high[2] = {__builtin_shufflevector(a.v, b.v, 1, 5, 3, 7),
                              __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7)};
    x[0] = {__builtin_shufflevector(low[0], low[1], 0, 1, 4, 5)};
    x[1] = {__builtin_shufflevector(high[0], high[1], 0, 1, 4, 5)};
    x[2] = {__builtin_shufflevector(low[0], low[1], 2, 3, 6, 7)};
  }
  CNEM_INLINE double dot(Small b) const { return component_sum(*this * b); }
  /// a × b.
  CNEM_INLINE friend Small cross(Small a, Small b) {
    const auto turned = [](Register x) { return __builtin_shufflevector(x, x, 1, 2, 0, 3); };
    return {turned(a.v * turned(b.v) - b.v * turned(a.v))};
  }
};

} // namespace cnem::CNEM_ISA
