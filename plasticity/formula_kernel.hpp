#pragma once
// How the return map evaluates a law that has nothing but its formula: flow_stress(law, strain, rate,
// temperature), on numbers with derivatives.
#include "plasticity/jet.hpp"

namespace cnem::plasticity::CNEM_ISA {

template<class T, class Law> class FormulaFlow;

/// Whether the flow stress may fall with strain: `may_fall` of the law, else false.
template<class Law> inline constexpr bool can_fall = false;
template<class Law>
requires(Law::may_fall) inline constexpr bool can_fall<Law> = true;

/// A law and a step.
template<class Law> struct FormulaKernel {
  template<class T> using Flow = FormulaFlow<T, Law>;
  Law law;
  double by_dt; ///< 1/s
};

/// What PlasticCorrector asks of the flow stress at points, here of any law whose stress does not fall with
/// rate, nor with strain unless the law says `may_fall`. PowerFlow says what the members are.
template<class T, class Law> class FormulaFlow {
public:
  static constexpr bool may_fall = can_fall<Law>;

  CNEM_INLINE FormulaFlow(const FormulaKernel<Law>& kernel, const T& plastic_strain, const T& temperature,
                          const T& strength)
      : at_rest(strength * flow_stress(kernel.law, plastic_strain, T(0.0), temperature)), kernel_(kernel),
        strain_(plastic_strain), temperature_(temperature), strength_(strength) {}

  T at_rest;

  using Parts = Jet<T>; ///< σ_y along Δx/x

  CNEM_INLINE T least() const { return may_fall ? T(0.0) : at_rest; }
  CNEM_INLINE T first_guess(T q, T cap) const { return may_fall ? cap * (T(1.0) - at_rest / q) : cap; }
  CNEM_INLINE Mask<T> in_range(const T& relative) const { return relative >= T(0.0); }
  CNEM_INLINE Parts quick(T x, const T&) const { return full(x); }
  CNEM_INLINE Parts full(T x) const {
    const T rate = x * T(kernel_.by_dt);
    return strength_ *
           flow_stress(kernel_.law, Jet<T>(strain_ + x, x, T(0.0)), Jet<T>(rate, rate, T(0.0)), temperature_);
  }
  template<class Modulus> ///< double, or T
  CNEM_INLINE T residual(T q, Modulus three_mu, T x, const Parts& stress, T& first, T& second) const {
    const T elastic = T(three_mu) * x;
    first = elastic + stress.first;
    second = -stress.second;
    if constexpr (may_fall) rose_ = rose_ | !(first > T(0.0));
    return q - elastic - stress.value;
  }

  /// Lanes in which q − 3μ x − σ_y has not fallen with x wherever `residual` was asked for.
  CNEM_INLINE Mask<T> rose() const { return rose_; }

private:
  const FormulaKernel<Law>& kernel_;
  T strain_, temperature_, strength_;
  mutable Mask<T> rose_ = T(0.0) > T(0.0);
};

/// Laws for which no faster way is known.
template<class Law> CNEM_INLINE FormulaKernel<Law> kernel_of(const Law& law, double dt) {
  return {law, 1.0 / dt};
}

} // namespace cnem::plasticity::CNEM_ISA
