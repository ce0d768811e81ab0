#pragma once
// Paper 004, Box 2, in terms of b_e, on a number type T (core/machine/simd.hpp). The F^p form of the paper
// gives the same numbers (tests/unit/plasticity); b_e needs neither polar decomposition nor F^p.
#include "core/machine/simd.hpp"
#include "plasticity/plastic_corrector.hpp"
#include "plasticity/return_map_parameters.hpp"
#include "plasticity/spectral.hpp"
#include "plasticity/trial_stress.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Elastic logarithmic strain beyond which a point is reported as meaningless.
inline constexpr double largest_strain = 100.0;

/// One step of the points i … i + Number<T>::width − 1 with the hardening of `kernel`. Returns the lanes that
/// mean nothing and were left alone.
template<int dim, class T, class Kernel>
CNEM_INLINE Mask<T> return_map_step(const ReturnMapParameters& law, const Kernel& kernel,
                                    const StressPoints<dim>& points, std::ptrdiff_t i) {
  constexpr int general = StressPoints<dim>::general, symmetric = StressPoints<dim>::symmetric;

  // (i) total deformation gradient
  T f[general], elastic[symmetric];
  for (int c = 0; c < general; ++c) f[c] = load<T>(points.deformation[c] + i);
  for (int c = 0; c < symmetric; ++c) elastic[c] = load<T>(points.inverse_plastic_cauchy_green[c] + i);
  const T temperature = load<T>(points.temperature + i);
  const T plastic_strain = load<T>(points.plastic_strain + i);
  const T last_rate = load<T>(points.plastic_rate + i);
  const T last_stress = load<T>(points.equivalent_stress + i);
  const T plastic_work = load<T>(points.plastic_work + i);
  const Deformation<dim, T> deformation(f);

  // (ii), (iii) elastic trial: b_e = F C_p⁻¹ Fᵀ = V_e²
  T b[symmetric];
  deformation.push_forward(elastic, b);

  // (iv) trial logarithmic strain, without its thermal part, (v) trial stress
  const TrialStress<dim, T> trial(b, law.two_mu);
  const T& total = trial.total;
  T volumetric = total;
  if (law.three_expansion != 0.0)
    volumetric = total - T(law.three_expansion) * (temperature - T(law.reference));
  const T tension = T(law.kappa) * volumetric;
  const T& q = trial.q;

  const T history = abs(plastic_work) + abs(last_stress);
  const T pressure = abs(tension);
  const Mask<T> valid = (deformation.determinant > T(0.0)) & trial.positive() & (temperature >= T(0.0)) &
                        (plastic_strain >= T(0.0)) & (last_rate >= T(0.0)) & (history < T(1e300)) &
                        (pressure < T(1e300)) & (q < T(largest_strain * law.two_mu));
  Mask<T> bad = !valid;

  T inverse[4];
  reciprocals(
      {deformation.determinant, trial.determinant(), max(q, T(1e-100)), max(plastic_strain, T(1e-100))},
      inverse);

  // (vi) plastic consistency, (vii) plastic corrector
  T increment = T(0.0), reduction = T(1.0), stress = q, work = T(0.0);
  if (law.plastic) {
    const PlasticCorrector<T, Kernel> corrector(law, kernel, plastic_strain, temperature,
                                                load<T>(points.strength + i));
    const Mask<T> yielding = valid & (q > corrector.initial_flow_stress());
    if (any(yielding)) {
      Mask<T> failed;
      increment = corrector.solve(q, inverse[3], last_rate * T(law.dt), yielding, failed);
      bad = bad | failed;
      const T shrink = T(law.three_mu) * increment * inverse[2];
      reduction = max(T(1.0) - shrink, T(0.0));
      stress = q * reduction; // once: a product that is fused here and not there would depend on other lanes
      work = T(0.5) * (last_stress + stress) * increment;

      // (ix) b_e = exp(−2 Δγ N) b_e^trial; C_p⁻¹ takes the difference, so that it does not drift when Δγ = 0
      T tensor[symmetric], delta[symmetric];
      trial.flow(T(-law.by_mu) * shrink, tensor);
      deformation.pull_back(tensor, inverse[0], delta);
      for (int c = 0; c < symmetric; ++c) {
        const T updated = elastic[c] + delta[c];
        store(points.inverse_plastic_cauchy_green[c] + i, select(yielding & !bad, updated, elastic[c]));
      }
    }
    store(points.plastic_rate + i, select(bad, last_rate, increment * T(law.by_dt)));
  }

  // (viii) stress: τ = dev τ^trial (1 − 3μ Δγ/q) − p 1, and P = τ cof F / J_e
  T tau[symmetric], piola[general];
  trial.stress(reduction, tension, tau);
  const T inverse_elastic_volume = sqrt(inverse[1]);
  deformation.piola(tau, inverse_elastic_volume, piola);

  const bool some_bad = any(bad);
  const auto write = [&](double* field, T value) {
    if (some_bad) value = select(bad, load<T>(field + i), value);
    store(field + i, value);
  };
  for (int c = 0; c < general; ++c) write(points.piola[c], piola[c]);
  write(points.plastic_strain, plastic_strain + increment);
  write(points.equivalent_stress, stress);
  write(points.plastic_work, plastic_work + work);
  write(points.dissipation, work);
  write(points.pressure, -tension);
  write(points.stored_energy, stress * stress * T(law.by_six_mu) + T(0.5) * tension * volumetric);
  write(points.stress_free, deformation.determinant * inverse_elastic_volume);
  return bad;
}

} // namespace cnem::plasticity::CNEM_ISA
