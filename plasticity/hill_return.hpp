#pragma once
// The return to Hill's yield surface, on a number type T (core/machine/simd.hpp).
#include "plasticity/elastic_trial.hpp"
#include "plasticity/hill_form.hpp"
#include "plasticity/material_frame.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// a : a.
template<int symmetric, class T> CNEM_INLINE T double_contraction(const T (&a)[symmetric]) {
  T sum = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  for (int c = 3; c < symmetric; ++c) sum = sum + T(2.0) * a[c] * a[c];
  return sum;
}

/// b = exp 2ε of the strain with the deviator s/2μ and the given mean.
template<int dim, class T>
CNEM_INLINE void exponential(const ReturnMapParameters& law, const T (&s)[StressPoints<dim>::symmetric],
                             const T& mean, T (&b)[StressPoints<dim>::symmetric]) {
  constexpr int symmetric = StressPoints<dim>::symmetric;
  // principal values come from positive definite tensors
  T shifted[symmetric];
  for (int c = 0; c < symmetric; ++c) shifted[c] = T(0.5 * law.by_mu) * s[c];
  const T shift = T(1.0) + sqrt(double_contraction<symmetric, T>(shifted));
  for (int c = 0; c < 3; ++c) shifted[c] = shifted[c] + shift;
  const Spectrum<dim, T> spectrum(shifted);
  T stretch[3];
  for (int k = 0; k < 3; ++k) stretch[k] = exp(T(2.0) * (spectrum.value[k] - shift + mean));
  spectrum.isotropic(stretch, b);
}

/// The stress on its way from the trial stress to the yield surface. With n = ∂σ̄/∂τ and elasticity that is
/// linear in logarithmic strain, τ = τ^trial − 2μ Δγ n; in the components a_k of HillForm
///   a_k = a_k^trial/(1 + ζ p_k),  ζ = 2μ Δγ/σ̄,
/// so that σ̄ and Δγ are closed functions of ζ. σ̄ falls with Δγ, ever more slowly.
template<int dim, class T> class HillReturn {
public:
  static constexpr int count = dim == 2 ? 3 : 5, symmetric = StressPoints<dim>::symmetric;

  /// Where ζ leads to.
  struct Place {
    T factor[count];     ///< –   a_k/a_k^trial
    T stress, increment; ///< Pa, –  σ̄, Δγ
    T slope, by_slope;   ///< Pa, 1/Pa  −dσ̄/dΔγ
  };

  /// deviator: trial stress in the frame of the material, without its mean, Pa.
  CNEM_INLINE HillReturn(const HillForm& form, const ReturnMapParameters& law, const T (&deviator)[symmetric])
      : form_(form), two_mu_(law.two_mu), by_two_mu_(0.5 * law.by_mu) {
    for (int k = 0; k < 2; ++k)
      trial_[k] = T(form.axis[k][0]) * deviator[0] + T(form.axis[k][1]) * deviator[1] +
                  T(form.axis[k][2]) * deviator[2];
    for (int k = 2; k < count; ++k) trial_[k] = deviator[k + 1];
    T sum = T(0.0);
    for (int k = 0; k < count; ++k) {
      share_[k] = T(k < 2 ? form.value[k] : 2.0 * form.value[k]) * trial_[k] * trial_[k];
      sum = sum + share_[k];
    }
    q = sqrt(sum);
  }

  T q; ///< Pa  σ̄ of the trial stress

  /// 1/q; before anything that follows.
  CNEM_INLINE void scale(const T& by_q) {
    by_q_ = by_q;
    for (int k = 0; k < count; ++k) share_[k] = share_[k] * by_q * by_q;
  }

  [[gnu::noinline]] void at(const T& zeta, Place& place) const {
    T denominator[count];
    for (int k = 0; k < count; ++k) denominator[k] = T(1.0) + zeta * T(form_.value[k]);
    reciprocals(denominator, place.factor);
    T square = T(0.0), first = T(0.0), second = T(0.0);
    for (int k = 0; k < count; ++k) {
      const T reduced = share_[k] * place.factor[k] * place.factor[k], cubed = reduced * place.factor[k];
      square = square + reduced;
      first = first + cubed;
      second = second + T(form_.value[k]) * cubed;
    }
    place.stress = q * sqrt(square);
    place.increment = zeta * place.stress * T(by_two_mu_);
    T inverse[2];
    reciprocals({max(first, T(1e-100)), max(second, T(1e-100))}, inverse);
    place.slope = T(two_mu_) * second * inverse[0];
    place.by_slope = T(by_two_mu_) * first * inverse[1];
  }

  /// The place of the lanes in `yielding` at which σ̄ is the flow stress; no flow in the others. `guess` and
  /// `last_stress` are Δγ and σ̄ of the last step. Each round puts the tangent of σ̄(Δγ) in the place of the
  /// line q − 3μ Δγ of von Mises: it lies below the curve, so that its root is short of the solution, and
  /// rounds approach it from one side, quadratically.
  template<class Corrector>
  CNEM_INLINE Place solve(const Corrector& corrector, ElasticTangent<T>& tangent, const T& by_strain,
                          const T& guess, const T& last_stress, const Mask<T>& yielding,
                          Mask<T>& failed) const {
    Place start, place;
    at(T(0.0), start);
    T zeta =
        select(yielding & (last_stress > T(0.0)), T(two_mu_) * guess / max(last_stress, T(1e-100)), T(0.0));
    T x = guess;
    at(zeta, place);
    Mask<T> open = yielding;
    failed = yielding & !yielding;
    for (int round = 0; round < 50 && any(open); ++round) {
      T intercept = place.stress + place.slope * place.increment;
      const Mask<T> short_of = intercept > corrector.initial_flow_stress();
      intercept = select(short_of, intercept, start.stress);
      tangent.three_mu = select(short_of, place.slope, start.slope);
      tangent.by_three_mu = select(short_of, place.by_slope, start.by_slope);
      const T reached = select(short_of, place.increment, T(0.0));
      Mask<T> unsolved;
      x = select(open, corrector.solve(intercept, by_strain, x, open, unsolved), x);
      failed = failed | unsolved;
      const T stress = max(intercept - tangent.three_mu * x, T(least_share) * q);
      zeta = select(open, T(two_mu_) * x / max(stress, T(1e-100)), zeta);
      at(zeta, place);
      open = open & !unsolved & !(abs(x - reached) <= T(tolerance) * x);
    }
    failed = failed | open;
    return place;
  }

  /// The stress there, without its mean, in the frame of the material, Pa.
  CNEM_INLINE void stress(const Place& place, T (&deviator)[symmetric]) const {
    const T a = trial_[0] * place.factor[0], b = trial_[1] * place.factor[1];
    for (int i = 0; i < 3; ++i) deviator[i] = T(form_.axis[0][i]) * a + T(form_.axis[1][i]) * b;
    for (int k = 2; k < count; ++k) deviator[k + 1] = trial_[k] * place.factor[k];
  }

private:
  /// |x − Δγ| of a tangent over x, whose square is the error left.
  static constexpr double tolerance = 1e-6;
  /// Of the trial stress, below which a flow stress is none: broken matter.
  static constexpr double least_share = 1e-25;

  const HillForm& form_;
  double two_mu_, by_two_mu_;
  T trial_[count]; ///< Pa  a_k^trial
  T share_[count]; ///< –   p_k a_k²/q²
  T by_q_;
};

struct HillParameters {
  const ReturnMapParameters& law;
  const HillForm& form;
};

/// A step before and after what depends on the hardening law: not inlined, so that there is one for all laws,
/// and whole packs and tails run the very same instructions.
template<int dim, class T> struct HillState {
  static constexpr int symmetric = StressPoints<dim>::symmetric;

  ElasticTrial<dim, T> trial;
  MaterialFrame<dim, T> frame;
  T mean;              ///< strain
  T tensor[symmetric]; ///< Pa  stress without its mean
  T turned[symmetric]; ///< Pa  that of the trial in the frame of the material
  HillReturn<dim, T> path;
  Mask<T> valid;
  T inverse[4]; ///< as of ElasticTrial::invert

  /// (i) to (v)
  [[gnu::noinline]] HillState(const ReturnMapParameters& law, const HillForm& form,
                              const StressPoints<dim>& points, std::ptrdiff_t i)
      : trial(law, points, i), frame(frame_of(trial, points, i)), mean(trial.total * T(1.0 / 3.0)),
        path(form, law, trial_stress(law)), valid(trial.valid(law, path.q)) {
    trial.invert(path.q, inverse);
    path.scale(inverse[2]);
  }

  /// (viii), (ix): stress, and b_e = exp 2ε_e.
  [[gnu::noinline]] void finish(const ReturnMapParameters& law,
                                const typename HillReturn<dim, T>::Place& place, const Mask<T>& yielding,
                                const Mask<T>& bad, const StressPoints<dim>& points, std::ptrdiff_t i) {
    Outcome<dim, T> outcome;
    outcome.stress = path.q;
    outcome.increment = outcome.work = T(0.0);
    if (any(yielding)) {
      T returned[symmetric], elastic[symmetric], stress[symmetric];
      path.stress(place, returned);
      frame.leave(returned, stress);
      for (int c = 0; c < symmetric; ++c) tensor[c] = select(yielding, stress[c], tensor[c]);
      outcome.stress = select(yielding, place.stress, path.q);
      outcome.increment = select(yielding, place.increment, T(0.0));
      outcome.work = T(0.5) * (trial.last_stress + outcome.stress) * outcome.increment;
      exponential<dim, T>(law, tensor, mean, elastic);
      for (int c = 0; c < symmetric; ++c) elastic[c] = elastic[c] - trial.b[c];
      add_elastic(trial, elastic, inverse[0], yielding & !bad, points, i);
    }
    if (law.plastic)
      store(points.plastic_rate + i, select(bad, trial.last_rate, outcome.increment * T(law.by_dt)));
    outcome.shear_energy = T(0.25 * law.by_mu) * double_contraction<symmetric, T>(tensor);
    for (int c = 0; c < symmetric; ++c) outcome.tau[c] = c < 3 ? tensor[c] + trial.tension : tensor[c];
    write_outcome(trial, outcome, inverse[1], bad, points, i);
  }

private:
  CNEM_INLINE static MaterialFrame<dim, T> frame_of(const ElasticTrial<dim, T>& trial,
                                                    const StressPoints<dim>& points, std::ptrdiff_t i) {
    constexpr int general = StressPoints<dim>::general;
    T earlier[general];
    for (int c = 0; c < general; ++c) earlier[c] = load<T>(points.earlier_deformation[c] + i);
    return {trial.f, earlier};
  }
  /// In the frame of the material; that in the model's goes to `tensor`.
  CNEM_INLINE const T (&trial_stress(const ReturnMapParameters& law))[symmetric] {
    T principal[3];
    for (int k = 0; k < 3; ++k) principal[k] = T(law.two_mu) * (trial.strain[k] - mean);
    trial.spectrum.isotropic(principal, tensor);
    frame.enter(tensor, turned);
    return turned;
  }
};

/// Box 2 with Hill's yield function in the frame of the material. b_e and its trial have no
/// principal directions in common: ln b_e takes the flow, ε_e = ε_e^trial − Δγ n, so that what the stored
/// energy loses is τ : Δγ n ≥ 0 and volume is kept.
template<int dim, class T, class Kernel>
CNEM_INLINE Mask<T> return_map_step(const HillParameters& parameters, const Kernel& kernel,
                                    const StressPoints<dim>& points, std::ptrdiff_t i) {
  const ReturnMapParameters& law = parameters.law;
  HillState<dim, T> state(law, parameters.form, points, i);
  const ElasticTrial<dim, T>& trial = state.trial;
  Mask<T> bad = !state.valid, yielding = state.valid & bad;
  typename HillReturn<dim, T>::Place place;
  // (vi) plastic consistency, (vii) plastic corrector
  if (law.plastic) {
    ElasticTangent<T> tangent;
    const PlasticCorrector<T, Kernel, ElasticTangent<T>> corrector(
        tangent, kernel, trial.plastic_strain, trial.temperature, load<T>(points.strength + i));
    yielding = state.valid & (state.path.q > corrector.initial_flow_stress());
    if (any(yielding)) {
      Mask<T> failed;
      place = state.path.solve(corrector, tangent, state.inverse[3], trial.last_rate * T(law.dt),
                               trial.last_stress, yielding, failed);
      bad = bad | failed;
    }
  }
  state.finish(law, place, yielding, bad, points, i);
  return bad;
}

} // namespace cnem::plasticity::CNEM_ISA
