#pragma once
// A position, force or column of a tensor inside kernels: dim doubles side by side, in the plane one 16-byte
// register of any x86-64. For kernel files only (core/machine/simd.hpp says why nothing common may be used
// there).
#include "core/machine/simd.hpp"

#include <cstddef>

namespace cnem::CNEM_ISA {

template<int dim> struct Small {
  double v[dim];

  CNEM_INLINE static Small zero() { return Small{}; }
  CNEM_INLINE static Small load(const double* p) {
    Small r;
    for (int k = 0; k < dim; ++k) r.v[k] = p[k];
    return r;
  }
  CNEM_INLINE void store(double* p) const {
    for (int k = 0; k < dim; ++k) p[k] = v[k];
  }
  CNEM_INLINE double operator[](int k) const { return v[k]; }
  CNEM_INLINE Small& operator+=(Small b) {
    for (int k = 0; k < dim; ++k) v[k] += b.v[k];
    return *this;
  }
  CNEM_INLINE Small& operator-=(Small b) {
    for (int k = 0; k < dim; ++k) v[k] -= b.v[k];
    return *this;
  }
  CNEM_INLINE friend Small operator+(Small a, Small b) { return a += b; }
  CNEM_INLINE friend Small operator-(Small a, Small b) { return a -= b; }
  CNEM_INLINE friend Small operator*(Small a, double s) {
    for (int k = 0; k < dim; ++k) a.v[k] *= s;
    return a;
  }
  CNEM_INLINE double dot(Small b) const {
    double sum = 0.0;
    for (int k = 0; k < dim; ++k) sum += v[k] * b.v[k];
    return sum;
  }
};

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

} // namespace cnem::CNEM_ISA
