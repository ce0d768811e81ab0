#pragma once
// Step (vii) of Box 2: the plastic increment Δγ of the Johnson-Cook law, on a number type T (core/simd.hpp).
#include "core/simd.hpp"
#include "plasticity/return_map_parameters.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Solves r(x) = q − 3μ x − σ_y(ε̄p + x, x/dt, T) = 0 for x = Δγ > 0, paper 004 (42).
///
/// r falls strictly from q − σ_y0 > 0 at 0 to something ≤ 0 at the cap (q − σ_y0)/3μ. Halley's method in the
/// relative increment η = Δx/x, started from the last step's rate, converges in two or three evaluations in
/// steady flow: the curvature that the logarithm of the rate gives r is what slows Newton's method. Points
/// that it leaves (first yield, ε̄p ≪ x, the kink at the reference rate) are finished within a bracket.
///
/// `saturating`: with the saturating hardening, known at compile time, because a branch on it here would
/// push the numbers out of the registers.
template<class T, bool saturating> class PlasticCorrector {
public:
  /// strength: factor on the flow stress, –.
  CNEM_INLINE PlasticCorrector(const ReturnMapParameters& parameters, T plastic_strain, T temperature,
                               T strength)
      : law(parameters), strain(plastic_strain) {
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
    initial_flow_stress = (T(law.A) + hardening) * softening;
  }

  /// σ_y at zero rate: the yield condition of step (vi).
  T initial_flow_stress;

  /// Δγ of the lanes in `yielding` (q > initial_flow_stress), 0 in the others; `guess` is Δγ of the last
  /// step. Lanes that fail to converge (none is known) are taken out of `yielding` and into `failed`.
  CNEM_INLINE T solve(T q, T by_strain, T guess, Mask<T> yielding, Mask<T>& failed) const {
    const T cap = (q - initial_flow_stress) * T(law.by_three_mu);
    T x = min(guess, cap);
    const Mask<T> fresh = yielding & (guess <= T(0.0));
    if (any(fresh)) x = select(fresh, first_guess(q, cap), x);

    Mask<T> open = yielding;
    for (int k = 0; k < 4; ++k) {
      const Mask<T> in_range = open & (x * by_strain <= T(law.series_range));
      if (!any(in_range)) break;
      const T eta = halley(q, x, series(x, x * by_strain));
      x = select(in_range, advance(x, eta, cap), x);
      open = open & !(in_range & (abs(eta) <= T(tolerance)));
    }
    if (any(open)) x = bracketed(q, x, cap, open);
    failed = open;
    return select(yielding, x, T(0.0));
  }

private:
  /// Hardening B ε̄pⁿ + Q (1 − exp(−δ ε̄p)) at ε̄p + x, Pa, with its first and second derivative times x and x².
  struct Hardening {
    T value, first, second;
  };

  /// |η| from which one more Halley step leaves a relative error of 0.11 |η|³.
  static constexpr double tolerance = 1e-4;

  const ReturnMapParameters& law;
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

  CNEM_INLINE void add_saturation(T x, Hardening& h) const {
    if constexpr (saturating) {
      const T left = T(law.saturation) * decay(strain + x), step = T(law.saturation_exponent) * x;
      h.value = h.value + T(law.saturation) - left;
      h.first = h.first + left * step;
      h.second = h.second - left * step * step;
    }
  }

  /// At x = y ε̄p within the range of the binomial series.
  CNEM_INLINE Hardening series(T x, T y) const {
    Hardening h{T(0.0), T(0.0), T(0.0)};
    if (law.B > 0.0) {
      T value = T(law.series[series_order]), slope = T(0.0);
      for (int k = series_order - 1; k >= 0; --k) {
        slope = slope * y + value;
        value = value * y + T(law.series[k]);
      }
      const T scale = T(law.B) * power;
      h.value = scale * value;
      h.first = scale * y * slope;
      h.second = T(law.n - 1.0) * h.first * y;
    }
    add_saturation(x, h);
    return h;
  }

  CNEM_INLINE Hardening full(T x) const {
    Hardening h{T(0.0), T(0.0), T(0.0)};
    if (law.B > 0.0) {
      const T total = strain + x, y = x / total;
      h.value = T(law.B) * power_of(total, log(total), law.n);
      h.first = T(law.n) * h.value * y;
      h.second = T(law.n - 1.0) * h.first * y;
    }
    add_saturation(x, h);
    return h;
  }

  CNEM_INLINE T residual_parts(T q, T x, const Hardening& h, T& first, T& second) const {
    const T stress = (T(law.A) + h.value) * softening;
    const T slope = h.first * softening, curvature = h.second * softening;
    T rate_factor = T(1.0), c = T(0.0);
    if (law.C > 0.0) {
      const T logarithm = log(x * T(law.by_reference_increment));
      const Mask<T> above = logarithm > T(0.0);
      rate_factor = T(1.0) + T(law.C) * select(above, logarithm, T(0.0));
      c = select(above, T(law.C), T(0.0));
    }
    const T elastic = T(law.three_mu) * x;
    first = elastic + slope * rate_factor + stress * c;                 // −r′ x
    second = stress * c - curvature * rate_factor - T(2.0) * slope * c; // r″ x²
    return q - elastic - stress * rate_factor;
  }

  /// η of Halley's method.
  CNEM_INLINE T halley(T q, T x, const Hardening& h) const {
    T first, second;
    const T r = residual_parts(q, x, h, first, second);
    return step(r, first, second);
  }

  CNEM_INLINE static T step(T r, T first, T second) {
    return T(2.0) * r * first / max(T(2.0) * first * first - r * second, T(0.5) * first * first);
  }

  CNEM_INLINE static T advance(T x, T eta, T cap) {
    return min(x * min(max(T(1.0) + eta, T(0.125)), T(8.0)), cap);
  }

  /// Below the cap and the solution without its elastic term, both of which are upper bounds.
  CNEM_INLINE T first_guess(T q, T cap) const {
    if (law.C == 0.0) return cap;
    const T overstress = (q / max(initial_flow_stress, T(1e-150)) - T(1.0)) * T(law.by_C);
    const T viscous = exp(min(overstress, T(600.0))) * T(law.reference_increment);
    return cap * viscous / (cap + viscous);
  }

  /// Halley within a bracket that is also bisected, geometrically; clears the lanes of `open` that it
  /// finishes.
  CNEM_INLINE T bracketed(T q, T start, T cap, Mask<T>& open) const {
    T low = T(0.0), high = cap, x = start;
    for (int k = 0; k < 400 && any(open); ++k) {
      T first, second;
      const T r = residual_parts(q, x, full(x), first, second);
      const T eta = step(r, first, second);
      low = select(open & (r > T(0.0)), x, low);
      high = select(open & (r <= T(0.0)), x, high);
      const Mask<T> done = (abs(eta) <= T(tolerance)) | (high - low <= T(1e-15) * high) | (high <= T(1e-290));
      T next = advance(x, eta, cap);
      const T middle = select(low > T(0.0), sqrt(low) * sqrt(high), high * T(0x1p-20));
      const Mask<T> outside = (k % 4 == 3) ? (next <= next) : ((next <= low) | (next >= high));
      next = select(outside & !done, middle, next);
      x = select(open, next, x);
      open = open & !done;
    }
    return x;
  }
};

} // namespace cnem::plasticity::CNEM_ISA
