#pragma once
// Step (vii) of Box 2: the plastic increment Δγ of any hardening law, on a number type T
// (core/machine/simd.hpp).
#include "core/machine/simd.hpp"
#include "plasticity/return_map_parameters.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Elasticity of which each lane has its own: what the trial stress loses per Δγ is the slope of a tangent.
template<class T> struct ElasticTangent {
  T three_mu, by_three_mu; ///< Pa, 1/Pa
};

/// Solves r(x) = q − 3μ x − σ_y(ε̄p + x, x/dt, T) = 0 for x = Δγ > 0, paper 004 (42), with the flow stress of
/// a Kernel (plasticity/power_kernel.hpp, formula_kernel.hpp) and 3μ of ReturnMapParameters or an
/// ElasticTangent.
///
/// r falls strictly from q − σ_y0 > 0 at 0 to something ≤ 0 at the cap (q − σ_y0)/3μ. Where the flow stress
/// may fall with strain (Flow::may_fall) the cap is q/3μ, at which r = −σ_y, and r falls as long as 3μ +
/// ∂σ_y/∂ε̄p + (∂σ_y/∂ε̄̇p)/dt > 0: then there is one solution. Halley's method in the relative increment η =
/// Δx/x, started from the last step's rate, converges in two or three evaluations in steady flow: the
/// curvature that the logarithm of the rate gives r is what slows Newton's method. Points that it leaves
/// (first yield, ε̄p ≪ x, the kink at the reference rate) are finished within a bracket.
template<class T, class Kernel, class Elasticity = ReturnMapParameters> class PlasticCorrector {
  using Flow = typename Kernel::template Flow<T>;

public:
  /// strength: factor on the flow stress, –.
  CNEM_INLINE PlasticCorrector(const Elasticity& parameters, const Kernel& kernel, T plastic_strain,
                               T temperature, T strength)
      : step(parameters), flow(kernel, plastic_strain, temperature, strength) {}

  /// σ_y at zero rate: the yield condition of step (vi).
  CNEM_INLINE const T& initial_flow_stress() const { return flow.at_rest; }

  /// Δγ of the lanes in `yielding` (q > initial_flow_stress), 0 in the others; `guess` is Δγ of the last
  /// step. Lanes that fail to converge (none is known) go into `failed`, and so do those in which r was seen
  /// to rise on the way: the solution may be one of several, or a jump.
  CNEM_INLINE T solve(T q, T by_strain, T guess, Mask<T> yielding, Mask<T>& failed) const {
    const T cap = (q - flow.least()) * T(step.by_three_mu);
    T x = min(guess, cap);
    const Mask<T> fresh = yielding & (guess <= T(0.0));
    if (any(fresh)) x = select(fresh, flow.first_guess(q, cap), x);

    Mask<T> open = yielding;
    for (int k = 0; k < 4; ++k) {
      const Mask<T> in_range = open & flow.in_range(x * by_strain);
      if (!any(in_range)) break;
      const T eta = halley(q, x, flow.quick(x, x * by_strain));
      x = select(in_range, advance(x, eta, cap), x);
      open = open & !(in_range & (abs(eta) <= T(tolerance)));
    }
    if (any(open)) x = bracketed(q, x, cap, open);
    failed = open;
    if constexpr (Flow::may_fall) failed = failed | (yielding & flow.rose());
    return select(yielding, x, T(0.0));
  }

private:
  /// |η| from which one more Halley step leaves a relative error of 0.11 |η|³.
  static constexpr double tolerance = 1e-4;

  const Elasticity& step;
  Flow flow;

  /// η of Halley's method.
  CNEM_INLINE T halley(T q, T x, const typename Flow::Parts& parts) const {
    T first, second;
    const T r = flow.residual(q, step.three_mu, x, parts, first, second);
    return relative_step(r, first, second);
  }

  CNEM_INLINE static T relative_step(T r, T first, T second) {
    return T(2.0) * r * first / max(T(2.0) * first * first - r * second, T(0.5) * first * first);
  }

  CNEM_INLINE static T advance(T x, T eta, T cap) {
    return min(x * min(max(T(1.0) + eta, T(0.125)), T(8.0)), cap);
  }

  /// Halley within a bracket that is also bisected, geometrically; clears the lanes of `open` that it
  /// finishes.
  CNEM_INLINE T bracketed(T q, T start, T cap, Mask<T>& open) const {
    T low = T(0.0), high = cap, x = start;
    for (int k = 0; k < 400 && any(open); ++k) {
      T first, second;
      const T r = flow.residual(q, step.three_mu, x, flow.full(x), first, second);
      const T eta = relative_step(r, first, second);
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
