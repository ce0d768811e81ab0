#pragma once
// The elastic trial stress of b_e = V_e² and what flow makes of it, on a number type T
// (core/machine/simd.hpp): logarithmic strain, Hooke's law, exponential.
#include "core/machine/simd.hpp"
#include "plasticity/spectral.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// In plane by principal values.
template<int dim, class T> class TrialStress {
public:
  static constexpr int symmetric = 4;

  T total; ///< –   ½ ln det b_e
  T q;     ///< Pa  von Mises' stress

  CNEM_INLINE TrialStress(const T (&b)[symmetric], double two_mu) : spectrum_(b) {
    const T(&l)[3] = spectrum_.value;
    T strain[3];
    logarithms(l, strain);
    for (T& e : strain) e = T(0.5) * e;
    total = strain[0] + strain[1] + strain[2];
    const T mean = total * T(1.0 / 3.0);
    for (int k = 0; k < 3; ++k) deviator_[k] = T(two_mu) * (strain[k] - mean);
    q = sqrt(T(1.5) *
             (deviator_[0] * deviator_[0] + deviator_[1] * deviator_[1] + deviator_[2] * deviator_[2]));
  }

  /// det b_e.
  CNEM_INLINE T determinant() const { return spectrum_.value[0] * spectrum_.value[1] * spectrum_.value[2]; }

  CNEM_INLINE Mask<T> positive() const {
    const T(&l)[3] = spectrum_.value;
    return (l[0] > T(0.0)) & (l[1] > T(0.0)) & (l[2] > T(0.0));
  }

  /// b_e (exp(factor · s) − 1) of the deviator s; factor in 1/Pa.
  CNEM_INLINE void flow(const T& factor, T (&change)[symmetric]) const {
    T principal[3];
    for (int k = 0; k < 3; ++k) principal[k] = spectrum_.value[k] * (exp(factor * deviator_[k]) - T(1.0));
    spectrum_.isotropic(principal, change);
  }

  /// τ = s · reduction + tension.
  CNEM_INLINE void stress(const T& reduction, const T& tension, T (&tau)[symmetric]) const {
    T principal[3];
    for (int k = 0; k < 3; ++k) principal[k] = deviator_[k] * reduction + tension;
    spectrum_.isotropic(principal, tau);
  }

private:
  Spectrum<dim, T> spectrum_;
  T deviator_[3]; ///< Pa
};

/// In space without principal values, as metals have it: b_e = m (1 + E) with tr E = 0 and small E, so that
/// E³ = J₂ E + J₃ 1 (Cayley and Hamilton) makes of every power series a polynomial of second degree whose
/// coefficients take two products a term. Shares of the strain that exceed `largest` are left to rotations.
template<class T> class TrialStress<3, T> {
public:
  static constexpr int symmetric = 6;

  T total, q;

  CNEM_INLINE TrialStress(const T (&b)[symmetric], double two_mu) : two_mu_(two_mu) {
    for (int c = 0; c < symmetric; ++c) b_[c] = b[c];
    // from differences to 1, which are exact in metals, so that volumes are
    T beyond[3];
    for (int c = 0; c < 3; ++c) beyond[c] = b[c] - T(1.0);
    const T shift = (beyond[0] + beyond[1] + beyond[2]) * T(1.0 / 3.0);
    mean_ = T(1.0) + shift;
    const T by_mean = T(1.0) / mean_;
    for (int c = 0; c < 3; ++c) e_[c] = (beyond[c] - shift) * by_mean;
    for (int c = 3; c < symmetric; ++c) e_[c] = b[c] * by_mean;
    square_[0] = e_[0] * e_[0] + e_[3] * e_[3] + e_[5] * e_[5];
    square_[1] = e_[3] * e_[3] + e_[1] * e_[1] + e_[4] * e_[4];
    square_[2] = e_[5] * e_[5] + e_[4] * e_[4] + e_[2] * e_[2];
    square_[3] = e_[0] * e_[3] + e_[3] * e_[1] + e_[5] * e_[4];
    square_[4] = e_[3] * e_[5] + e_[1] * e_[4] + e_[4] * e_[2];
    square_[5] = e_[0] * e_[5] + e_[3] * e_[4] + e_[5] * e_[2];
    j2_ = T(0.5) * (square_[0] + square_[1] + square_[2]);
    j3_ = e_[0] * (e_[1] * e_[2] - e_[4] * e_[4]) - e_[3] * (e_[3] * e_[2] - e_[4] * e_[5]) +
          e_[5] * (e_[3] * e_[4] - e_[1] * e_[5]);
    small_ = (mean_ > T(0.0)) & (j2_ <= T(0.75 * largest * largest));

    // ln (1 + E) = E Σ (−E)^k/(k+1)
    constexpr double series[] = {1.0,     -1.0 / 2, 1.0 / 3, -1.0 / 4,  1.0 / 5,  -1.0 / 6,
                                 1.0 / 7, -1.0 / 8, 1.0 / 9, -1.0 / 10, 1.0 / 11, -1.0 / 12};
    T p[3];
    horner(series, j2_, j3_, p);
    const T trace = T(2.0) * j2_ * p[1] + T(3.0) * j3_ * p[2];
    const T rounded = shift - (mean_ - T(1.0));
    total = T(1.5) * (log(mean_) + rounded * by_mean) + T(0.5) * trace;
    linear_ = T(0.5) * (p[0] + j2_ * p[2]);
    quadratic_ = T(0.5) * p[1];
    const T third = T(1.0 / 3.0) * j2_;
    const T norm = linear_ * linear_ * j2_ + quadratic_ * (quadratic_ * j2_ * third + T(3.0) * linear_ * j3_);
    const Mask<T> distorted = j2_ > T(0x1p-106); // beyond the rounding of b
    q = select(distorted, T(two_mu) * sqrt(T(3.0) * max(norm, T(0.0))), T(0.0));
    determinant_ = mean_ * mean_ * mean_ * ((T(1.0) - j2_) + j3_);
    const T two_thirds = third + third;
    const T a1 = T(two_mu) * linear_, a2 = T(two_mu) * quadratic_;
    for (int c = 0; c < symmetric; ++c)
      deviator_[c] = a2 * (c < 3 ? square_[c] - two_thirds : square_[c]) + a1 * e_[c];
    positive_ = small_;
    if (any(!small_)) { // copies: what a call knows the address of is left in memory
      T copy[symmetric];
      for (int c = 0; c < symmetric; ++c) copy[c] = b_[c];
      Rotated rotated;
      rotate(copy, two_mu, rotated);
      total = select(small_, total, rotated.total);
      q = select(small_, q, rotated.q);
      determinant_ = select(small_, determinant_, rotated.determinant);
      for (int c = 0; c < symmetric; ++c) deviator_[c] = select(small_, deviator_[c], rotated.deviator[c]);
      positive_ = small_ | rotated.positive;
    }
  }

  CNEM_INLINE T determinant() const { return determinant_; }
  CNEM_INLINE Mask<T> positive() const { return positive_; }

  CNEM_INLINE void flow(const T& factor, T (&change)[symmetric]) const {
    // exp X − 1 = X Σ X^k/(k+1)!, X = factor s = x₂ (E² − ⅔ J₂) + x₁ E
    const T scale = factor * T(two_mu_), x1 = scale * linear_, x2 = scale * quadratic_;
    const T third = T(1.0 / 3.0) * j2_, x0 = T(-2.0) * third * x2;
    const T x11 = x1 * x1, x12 = x1 * x2, x22 = x2 * x2;
    const T j2 = x11 * j2_ + x22 * j2_ * third + T(3.0) * x12 * j3_;
    const T j3 = x1 * (x11 * j3_ + x22 * j2_ * j3_) + T(2.0) * x11 * x2 * j2_ * third +
                 x22 * x2 * (j3_ * j3_ - T(2.0 / 27.0) * j2_ * j2_ * j2_);
    constexpr double series[] = {1.0,       1.0 / 2,    1.0 / 6,     1.0 / 24,    1.0 / 120,
                                 1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880};
    T p[3];
    horner(series, j2, j3, p);
    const T first = p[0] + j2 * p[2];
    // X² = y₂ E² + y₁ E + y₀, and (1 + E)(r₂ E² + r₁ E + r₀)
    const T r2 = p[1] * (x11 - x22 * third) + first * x2;
    const T r1 = p[1] * (x22 * j3_ + T(2.0) * x12 * third) + first * x1;
    const T r0 = p[1] * (T(2.0) * x12 * j3_ + x0 * x0) + first * x0 + j3 * p[2];
    const T c2 = mean_ * (r2 + r1), c1 = mean_ * (r1 + r0 + j2_ * r2), c0 = mean_ * (r0 + j3_ * r2);
    for (int c = 0; c < symmetric; ++c) {
      change[c] = c2 * square_[c] + c1 * e_[c];
      if (c < 3) change[c] = change[c] + c0;
    }
    if (any(!small_)) {
      T copy[symmetric], by_rotations[symmetric], exponent = factor;
      for (int c = 0; c < symmetric; ++c) copy[c] = b_[c];
      flow_by_rotations(copy, two_mu_, exponent, by_rotations);
      for (int c = 0; c < symmetric; ++c) change[c] = select(small_, change[c], by_rotations[c]);
    }
  }

  CNEM_INLINE void stress(const T& reduction, const T& tension, T (&tau)[symmetric]) const {
    for (int c = 0; c < symmetric; ++c) {
      tau[c] = deviator_[c] * reduction;
      if (c < 3) tau[c] = tau[c] + tension;
    }
  }

private:
  /// Of the principal values of E: what the series leave out is below 2e-18 of their sums.
  static constexpr double largest = 0.04;

  /// p₂ E² + p₁ E + p₀ = Σ c_k E^k.
  template<int n> CNEM_INLINE static void horner(const double (&c)[n], const T& j2, const T& j3, T (&p)[3]) {
    p[0] = T(c[n - 3]);
    p[1] = T(c[n - 2]);
    p[2] = T(c[n - 1]);
    for (int k = n - 4; k >= 0; --k) {
      const T top = p[2];
      p[2] = p[1];
      p[1] = p[0] + j2 * top;
      p[0] = T(c[k]) + j3 * top;
    }
  }

  struct Rotated {
    T total, q, determinant, deviator[symmetric];
    Mask<T> positive;
  };

  /// s by principal values, whose sum of logarithmic strains this returns.
  CNEM_INLINE static T principal(const Spectrum<3, T>& spectrum, double two_mu, T (&s)[3]) {
    T strain[3];
    logarithms(spectrum.value, strain);
    for (T& e : strain) e = T(0.5) * e;
    const T sum = strain[0] + strain[1] + strain[2], mean = sum * T(1.0 / 3.0);
    for (int k = 0; k < 3; ++k) s[k] = T(two_mu) * (strain[k] - mean);
    return sum;
  }

  CNEM_ONE_COPY static void rotate(const T (&b)[symmetric], double two_mu, Rotated& result) {
    const Spectrum<3, T> spectrum(b);
    const T(&l)[3] = spectrum.value;
    T s[3];
    result.total = principal(spectrum, two_mu, s);
    result.q = sqrt(T(1.5) * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]));
    result.determinant = l[0] * l[1] * l[2];
    result.positive = (l[0] > T(0.0)) & (l[1] > T(0.0)) & (l[2] > T(0.0));
    spectrum.isotropic(s, result.deviator);
  }

  CNEM_ONE_COPY static void flow_by_rotations(const T (&b)[symmetric], double two_mu, const T& factor,
                                              T (&change)[symmetric]) {
    const Spectrum<3, T> spectrum(b);
    T s[3];
    principal(spectrum, two_mu, s);
    for (int k = 0; k < 3; ++k) s[k] = spectrum.value[k] * (exp(factor * s[k]) - T(1.0));
    spectrum.isotropic(s, change);
  }

  double two_mu_;
  T b_[symmetric], mean_;
  T e_[symmetric], square_[symmetric]; ///< E, E²
  T j2_, j3_;                          ///< ½ E : E, det E
  T linear_, quadratic_;               ///< ½ ln (1 + E) without its trace, by E and E² − ⅔ J₂
  T deviator_[symmetric];              ///< Pa  s
  T determinant_;
  Mask<T> small_, positive_;
};

} // namespace cnem::plasticity::CNEM_ISA
