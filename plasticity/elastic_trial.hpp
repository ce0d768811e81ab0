#pragma once
// The parts of Box 2 that do not know the yield function, on a number type T (core/machine/simd.hpp).
// return_map_step() (plasticity/box2.hpp) has them in line: where they are objects the compiler leaves its
// packs in memory, which took AVX-512 from 50 to 150 ns per point.
#include "plasticity/box2.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// What the points i … i + Number<T>::width − 1 are at t_n and would be at t_{n+1} without flow.
template<int dim, class T> struct ElasticTrial {
  static constexpr int general = StressPoints<dim>::general, symmetric = StressPoints<dim>::symmetric;

  T f[general], elastic[symmetric]; ///< F, C_p⁻¹
  T temperature, plastic_strain, last_rate, last_stress, plastic_work;
  Deformation<dim, T> deformation;
  T b[symmetric]; ///< b_e
  Spectrum<dim, T> spectrum;
  T strain[3];         ///< principal logarithmic strains
  T total, volumetric; ///< their sum, and that without its thermal part
  T tension;           ///< Pa, −p

  CNEM_INLINE ElasticTrial(const ReturnMapParameters& law, const StressPoints<dim>& points, std::ptrdiff_t i)
      : deformation(read(points, i)), spectrum(push_forward()) {
    logarithms(spectrum.value, strain);
    for (T& e : strain) e = T(0.5) * e;
    total = strain[0] + strain[1] + strain[2];
    volumetric = total;
    if (law.three_expansion != 0.0)
      volumetric = total - T(law.three_expansion) * (temperature - T(law.reference));
    tension = T(law.kappa) * volumetric;
  }

  /// Lanes that mean something; q: equivalent trial stress, Pa.
  CNEM_INLINE Mask<T> valid(const ReturnMapParameters& law, const T& q) const {
    const T(&l)[3] = spectrum.value;
    const T history = abs(plastic_work) + abs(last_stress);
    const T pressure = abs(tension);
    return (deformation.determinant > T(0.0)) & (l[0] > T(0.0)) & (l[1] > T(0.0)) & (l[2] > T(0.0)) &
           (temperature >= T(0.0)) & (plastic_strain >= T(0.0)) & (last_rate >= T(0.0)) &
           (history < T(1e300)) & (pressure < T(1e300)) & (q < T(largest_strain * law.two_mu));
  }

  /// 1/det F, 1/det b_e, 1/q, 1/ε̄p.
  CNEM_INLINE void invert(const T& q, T (&inverse)[4]) const {
    const T(&l)[3] = spectrum.value;
    reciprocals(
        {deformation.determinant, l[0] * l[1] * l[2], max(q, T(1e-100)), max(plastic_strain, T(1e-100))},
        inverse);
  }

private:
  /// (i) total deformation gradient
  CNEM_INLINE const T (&read(const StressPoints<dim>& points, std::ptrdiff_t i))[general] {
    for (int c = 0; c < general; ++c) f[c] = load<T>(points.deformation[c] + i);
    for (int c = 0; c < symmetric; ++c) elastic[c] = load<T>(points.inverse_plastic_cauchy_green[c] + i);
    temperature = load<T>(points.temperature + i);
    plastic_strain = load<T>(points.plastic_strain + i);
    last_rate = load<T>(points.plastic_rate + i);
    last_stress = load<T>(points.equivalent_stress + i);
    plastic_work = load<T>(points.plastic_work + i);
    return f;
  }
  /// (ii), (iii) elastic trial: b_e = F C_p⁻¹ Fᵀ = V_e², with its principal directions instead of a rotation
  CNEM_INLINE const T (&push_forward())[symmetric] {
    deformation.push_forward(elastic, b);
    return b;
  }
};

/// (ix) C_p⁻¹ of the lanes that flow takes the difference of b_e, so that it does not drift when Δγ = 0.
template<int dim, class T>
CNEM_INLINE void add_elastic(const ElasticTrial<dim, T>& trial,
                             const T (&difference)[StressPoints<dim>::symmetric], const T& by_determinant,
                             const Mask<T>& flowing, const StressPoints<dim>& points, std::ptrdiff_t i) {
  constexpr int symmetric = StressPoints<dim>::symmetric;
  T delta[symmetric];
  trial.deformation.pull_back(difference, by_determinant, delta);
  for (int c = 0; c < symmetric; ++c) {
    const T updated = trial.elastic[c] + delta[c];
    store(points.inverse_plastic_cauchy_green[c] + i, select(flowing, updated, trial.elastic[c]));
  }
}

/// What a step has come to.
template<int dim, class T> struct Outcome {
  T tau[StressPoints<dim>::symmetric];
  T stress;       ///< Pa    equivalent stress
  T shear_energy; ///< J/m³  stored without volume change
  T increment;    ///< –     Δγ
  T work;         ///< J/m³  of it
};

/// Writes the lanes that are not in `bad`.
template<int dim, class T>
CNEM_INLINE void write_outcome(const ElasticTrial<dim, T>& trial, const Outcome<dim, T>& outcome,
                               const T& by_elastic_square, const Mask<T>& bad,
                               const StressPoints<dim>& points, std::ptrdiff_t i) {
  constexpr int general = StressPoints<dim>::general;
  T piola[general];
  const T inverse_elastic_volume = sqrt(by_elastic_square);
  trial.deformation.piola(outcome.tau, inverse_elastic_volume, piola);
  const bool some_bad = any(bad);
  const auto write = [&](double* field, T value) {
    if (some_bad) value = select(bad, load<T>(field + i), value);
    store(field + i, value);
  };
  for (int c = 0; c < general; ++c) write(points.piola[c], piola[c]);
  write(points.plastic_strain, trial.plastic_strain + outcome.increment);
  write(points.equivalent_stress, outcome.stress);
  write(points.plastic_work, trial.plastic_work + outcome.work);
  write(points.dissipation, outcome.work);
  write(points.pressure, -trial.tension);
  write(points.stored_energy, outcome.shear_energy + T(0.5) * trial.tension * trial.volumetric);
  write(points.stress_free, trial.deformation.determinant * inverse_elastic_volume);
}

} // namespace cnem::plasticity::CNEM_ISA
