#pragma once
// Numbers with derivatives and the functions of formulas on them, so that a law is written once, as its
// formula, and has slope and curvature. In kernels T is a pack; elsewhere it is double with the functions of
// the C library.
#include "core/machine/simd.hpp"

#ifndef CNEM_PACK
#include <cmath>
#endif

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// A value with its first and second derivative along one direction.
template<class T> struct Jet {
  T value, first, second;

  CNEM_INLINE explicit Jet(T v) : value(v), first(T(0.0)), second(T(0.0)) {}
  CNEM_INLINE Jet(T v, T d, T dd) : value(v), first(d), second(dd) {}

  CNEM_INLINE friend Jet operator+(Jet a, Jet b) {
    return {a.value + b.value, a.first + b.first, a.second + b.second};
  }
  CNEM_INLINE friend Jet operator-(Jet a, Jet b) {
    return {a.value - b.value, a.first - b.first, a.second - b.second};
  }
  CNEM_INLINE friend Jet operator*(Jet a, Jet b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + T(2.0) * a.first * b.first + a.value * b.second};
  }
  CNEM_INLINE friend Jet operator+(T a, Jet b) { return {a + b.value, b.first, b.second}; }
  CNEM_INLINE friend Jet operator+(Jet a, T b) { return b + a; }
  CNEM_INLINE friend Jet operator-(T a, Jet b) { return {a - b.value, -b.first, -b.second}; }
  CNEM_INLINE friend Jet operator-(Jet a, T b) { return {a.value - b, a.first, a.second}; }
  CNEM_INLINE friend Jet operator*(T a, Jet b) { return {a * b.value, a * b.first, a * b.second}; }
  CNEM_INLINE friend Jet operator*(Jet a, T b) { return b * a; }
  CNEM_INLINE friend Jet operator/(Jet a, T b) { return {a.value / b, a.first / b, a.second / b}; }
};

template<class T> CNEM_INLINE T value_of(T x) { return x; }
template<class T> CNEM_INLINE T value_of(Jet<T> x) { return x.value; }

// --- e^x, ln x, x^p and tanh x of a number; exponents are clipped where a double would overflow ---

#ifdef CNEM_PACK
template<int n> CNEM_INLINE Pack<n> exponential(Pack<n> x) {
  return exp(min(max(x, Pack<n>(-708.0)), Pack<n>(708.0)));
}
template<int n> CNEM_INLINE Pack<n> logarithm(Pack<n> x) { return log(x); }
/// 0 at x = 0.
template<int n> CNEM_INLINE Pack<n> power(Pack<n> x, double p) {
  return select(x > Pack<n>(0.0), exponential(Pack<n>(p) * log(x)), Pack<n>(0.0));
}
/// d(x^p)/dx, where x^p is known; x > 0.
template<int n> CNEM_INLINE Pack<n> slope_of_power(Pack<n> x, double p, Pack<n> power) {
  return Pack<n>(p) * power / x;
}
/// To 1 ulp of 1, not of itself where x is small.
template<int n> CNEM_INLINE Pack<n> hyperbolic_tangent(Pack<n> x) {
  return Pack<n>(1.0) - Pack<n>(2.0) / (Pack<n>(1.0) + exponential(x + x));
}
#else
inline double exponential(double x) { return std::exp(x); }
inline double logarithm(double x) { return std::log(x); }
inline double power(double x, double p) { return std::pow(x, p); }
inline double slope_of_power(double x, double p, double) { return p * std::pow(x, p - 1.0); }
inline double hyperbolic_tangent(double x) { return std::tanh(x); }
#endif

template<class T> CNEM_INLINE Jet<T> exponential(Jet<T> x) {
  const T e = exponential(x.value);
  return {e, e * x.first, e * (x.second + x.first * x.first)};
}
template<class T> CNEM_INLINE Jet<T> logarithm(Jet<T> x) {
  const T d = x.first / x.value;
  return {logarithm(x.value), d, x.second / x.value - d * d};
}
template<class T> CNEM_INLINE Jet<T> power(Jet<T> x, double p) {
  const T value = power(x.value, p), slope = slope_of_power(x.value, p, value);
  return {value, slope * x.first, slope * (x.second + T(p - 1.0) * x.first * x.first / x.value)};
}
template<class T> CNEM_INLINE Jet<T> hyperbolic_tangent(Jet<T> x) {
  const T t = hyperbolic_tangent(x.value), d = T(1.0) - t * t;
  return {t, d * x.first, d * (x.second - T(2.0) * t * x.first * x.first)};
}

/// The larger of x and a constant, without slope where that is the constant.
template<class T> CNEM_INLINE T at_least(T x, double low) { return max(x, T(low)); }
template<class T> CNEM_INLINE Jet<T> at_least(Jet<T> x, double low) {
  const Mask<T> above = x.value > T(low);
  return {max(x.value, T(low)), select(above, x.first, T(0.0)), select(above, x.second, T(0.0))};
}

} // namespace cnem::plasticity::CNEM_ISA
