#pragma once
// How the return map evaluates laws of the form
//   σ_y = (A + B ε̄pⁿ + Q (1 − e^{−δ ε̄p})) (1 + C ln⁺(ε̄̇p/ε̄̇0)) (1 − T*ᵐ),
// T* = clip((T − T0)/(T_m − T0), 0, 1), ln⁺ zero below the reference rate: Johnson and Cook with Q = 0, Voce
// with C = 0 and without T*, linear and perfect plasticity. Most runs spend their time here.
#include "core/machine/simd.hpp"
#include "core/parameter.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Highest power in the binomial series of (1 + y)ⁿ.
inline constexpr int series_order = 10;

template<class T, bool saturating> class PowerFlow;

/// Constants of a law of this form, as above.
struct PowerConstants {
  double A = 0.0, B = 0.0;           ///< Pa
  double n = 1.0;                    ///< –
  double C = 0.0;                    ///< –
  double rate0 = 1.0;                ///< 1/s
  double m = 1.0;                    ///< –
  double T0 = 0.0, Tmelt = infinite; ///< K
  double saturation = 0.0;           ///< Pa   Q
  double saturation_exponent = 0.0;  ///< –    δ
};

/// The same with what follows from them and the step; what would cost a division is kept inverted.
/// `saturating`: with the saturating hardening, known at compile time, because a branch on it would push the
/// numbers out of the registers.
template<bool saturating> struct PowerKernel : PowerConstants {
  template<class T> using Flow = PowerFlow<T, saturating>;

  double by_melting_range;             ///< 1/K  1/(T_m − T0); 0: no thermal softening
  double reference_increment;          ///< –    ε̄̇p0 dt
  double by_reference_increment, by_C; ///< –    1/(ε̄̇p0 dt), 1/C
  double series[series_order + 1];     ///< –    binomial coefficients: (1 + y)ⁿ = Σ series_k y^k
  double series_range;                 ///< –    y up to which the series is exact to rounding

  /// Not inlined: constants that a law leaves at 0 would be folded into its loops, whose products and sums
  /// are then fused in another way, so that laws would differ by roundings.
  [[gnu::noinline]] PowerKernel(const PowerConstants& law, double dt) : PowerConstants(law) {
    by_melting_range = 1.0 / (law.Tmelt - law.T0);
    reference_increment = dt * law.rate0;
    by_reference_increment = 1.0 / reference_increment;
    by_C = 1.0 / law.C;
    double coefficient = 1.0;
    for (int k = 0; k <= series_order; ++k) {
      series[k] = coefficient;
      coefficient *= (law.n - k) / (k + 1);
    }
    // The first term left out bounds the error of the series for 0 ≤ y < 1.
    constexpr double rounding = 1e-17, longest = 0.05;
    series_range = coefficient == 0.0
                       ? longest
                       : min(longest, exp(log(rounding / abs(coefficient)) * (1.0 / (series_order + 1))));
  }
};

/// The flow stress at points of strain ε̄p and temperature T, as PlasticCorrector asks for it. Packs come by
/// reference: each copy more is one that the compiler may leave in memory, at twice the time of a step.
template<class T, bool saturating> class PowerFlow {
public:
  static constexpr bool may_fall = false; ///< σ_y with strain, at fixed rate and temperature

  /// strength: factor on the flow stress, –.
  CNEM_INLINE PowerFlow(const PowerKernel<saturating>& kernel, const T& plastic_strain, const T& temperature,
                        const T& strength)
      : law(kernel), strain(plastic_strain) {
    const T homologous = min(max((temperature - T(law.T0)) * T(law.by_melting_range), T(0.0)), T(1.0));
    T logarithm[2];
    logarithms({homologous, strain}, logarithm);
    power = law.B > 0.0 ? power_of(strain, logarithm[1], law.n) : T(0.0);
    softening = strength;
    if (any(homologous > T(0.0)))
      softening =
          strength * (T(1.0) - (law.m == 1.0 ? homologous : power_of(homologous, logarithm[0], law.m)));
    T hardening = T(law.B) * power;
    if constexpr (saturating) hardening = hardening + T(law.saturation) * (T(1.0) - decay(strain));
    at_rest = (T(law.A) + hardening) * softening;
  }

  /// σ_y at ε̄p and zero rate, Pa.
  T at_rest;

  /// A bound of σ_y from below at larger strains, Pa.
  CNEM_INLINE const T& least() const { return at_rest; }

  /// Where to look first for Δγ of points that did not flow in the last step; `cap` bounds it from above, as
  /// does the solution without its elastic term.
  CNEM_INLINE T first_guess(T q, T cap) const {
    if (law.C == 0.0) return cap;
    const T overstress = (q / max(at_rest, T(1e-150)) - T(1.0)) * T(law.by_C);
    const T viscous = exp(min(overstress, T(600.0))) * T(law.reference_increment);
    return cap * viscous / (cap + viscous);
  }

  /// Hardening B ε̄pⁿ + Q (1 − exp(−δ ε̄p)) at ε̄p + x, Pa, with its first and second derivative times x and x².
  struct Parts {
    T value, first, second;
  };

  /// Whether `quick` holds at x = `relative` ε̄p.
  CNEM_INLINE Mask<T> in_range(const T& relative) const { return relative <= T(law.series_range); }

  /// What `residual` wants to know at x = `relative` ε̄p in that range, and at any x.
  CNEM_INLINE Parts quick(T x, const T& relative) const {
    Parts h{T(0.0), T(0.0), T(0.0)};
    if (law.B > 0.0) {
      T value = T(law.series[series_order]), slope = T(0.0);
      for (int k = series_order - 1; k >= 0; --k) {
        slope = slope * relative + value;
        value = value * relative + T(law.series[k]);
      }
      const T scale = T(law.B) * power;
      h.value = scale * value;
      h.first = scale * relative * slope;
      h.second = T(law.n - 1.0) * h.first * relative;
    }
    add_saturation(x, h);
    return h;
  }
  CNEM_INLINE Parts full(T x) const {
    Parts h{T(0.0), T(0.0), T(0.0)};
    if (law.B > 0.0) {
      const T total = strain + x, y = x / total;
      h.value = T(law.B) * power_of(total, log(total), law.n);
      h.first = T(law.n) * h.value * y;
      h.second = T(law.n - 1.0) * h.first * y;
    }
    add_saturation(x, h);
    return h;
  }

  /// r(x) = q − 3μ x − σ_y(ε̄p + x, x/dt), with −r′x in `first` and r″x² in `second`.
  template<class Modulus> ///< double, or T
  CNEM_INLINE T residual(T q, Modulus three_mu, T x, const Parts& h, T& first, T& second) const {
    const T stress = (T(law.A) + h.value) * softening;
    const T slope = h.first * softening, curvature = h.second * softening;
    T rate_factor = T(1.0), c = T(0.0);
    if (law.C > 0.0) {
      const T logarithm = log(x * T(law.by_reference_increment));
      const Mask<T> above = logarithm > T(0.0);
      rate_factor = T(1.0) + T(law.C) * select(above, logarithm, T(0.0));
      c = select(above, T(law.C), T(0.0));
    }
    const T elastic = T(three_mu) * x;
    first = elastic + slope * rate_factor + stress * c;
    second = stress * c - curvature * rate_factor - T(2.0) * slope * c;
    return q - elastic - stress * rate_factor;
  }

private:
  const PowerKernel<saturating>& law;
  T strain;
  T softening; ///< 1 − T*ᵐ, times the strength
  T power;     ///< ε̄pⁿ at t_n

  /// x^p, 0 at x = 0.
  CNEM_INLINE static T power_of(T x, T logarithm, double p) {
    return select(x > T(0.0), exp(max(T(p) * logarithm, T(-708.0))), T(0.0));
  }

  CNEM_INLINE T decay(T plastic_strain) const {
    return exp(max(T(-law.saturation_exponent) * plastic_strain, T(-708.0)));
  }

  CNEM_INLINE void add_saturation(T x, Parts& h) const {
    if constexpr (saturating) {
      const T left = T(law.saturation) * decay(strain + x), step = T(law.saturation_exponent) * x;
      h.value = h.value + T(law.saturation) - left;
      h.first = h.first + left * step;
      h.second = h.second - left * step * step;
    }
  }
};

} // namespace cnem::plasticity::CNEM_ISA
