#include "core/cofactor.hpp"
#include "core/machine/simd.hpp"
#include "plasticity/damage_laws/list.hpp"
#include "plasticity/damage_points.hpp"
#include "plasticity/initiated.hpp"
#include "plasticity/spectral.hpp"
#include "plasticity/with_law.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

namespace {

/// A fracture strain that the law puts at or below 0 means initiation with the first flow.
constexpr double no_ductility = 1e-12;

template<class Law> inline constexpr bool asks_for_largest = false;
template<class Law>
requires(Law::of_largest_stress) inline constexpr bool asks_for_largest<Law> = true;

/// σ1 of τ = P Fᵀ V_reference/V_stress-free.
template<class T> CNEM_INLINE T largest_principal(const DamagePoints<2>& points, std::ptrdiff_t p) {
  T f[5], stress[5];
  for (int c = 0; c < 5; ++c) {
    f[c] = load<T>(points.stress.deformation[c] + p);
    stress[c] = load<T>(points.stress.piola[c] + p);
  }
  const T xx = stress[0] * f[0] + stress[1] * f[1], xy = stress[0] * f[2] + stress[1] * f[3];
  const T yy = stress[2] * f[2] + stress[3] * f[3], zz = stress[4] * f[4];
  const T mean = T(0.5) * (xx + yy), difference = T(0.5) * (xx - yy);
  return max(mean + sqrt(difference * difference + xy * xy), zz) / load<T>(points.stress.stress_free + p);
}
template<class T> CNEM_INLINE T largest_principal(const DamagePoints<3>& points, std::ptrdiff_t p) {
  T f[9], stress[9];
  for (int c = 0; c < 9; ++c) {
    f[c] = load<T>(points.stress.deformation[c] + p);
    stress[c] = load<T>(points.stress.piola[c] + p);
  }
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  T tau[6];
  for (int c = 0; c < 6; ++c) {
    tau[c] = T(0.0);
    for (int k = 0; k < 3; ++k) tau[c] = tau[c] + stress[3 * row[c] + k] * f[3 * column[c] + k];
  }
  const Spectrum<3, T> spectrum(tau);
  return max(max(spectrum.value[0], spectrum.value[1]), spectrum.value[2]) /
         load<T>(points.stress.stress_free + p);
}

/// D, ω and the strain at initiation of the points that flow.
template<int dim, class T, class Law>
CNEM_INLINE void accumulate(const DamageParameters& parameters, const Law& law,
                            const DamagePoints<dim>& points, std::ptrdiff_t p, Mask<T> flowing, T damage,
                            T gap, T borne, T& softening) {
  const T rate = load<T>(points.stress.plastic_rate + p);
  const Mask<T> softens = flowing & initiated(damage, softening);
  const Mask<T> sound = flowing & !softens;
  if (any(sound)) {
    Flowing<T> at;
    at.equivalent = max(load<T>(points.stress.equivalent_stress + p), T(1e-100));
    at.triaxiality = -borne / at.equivalent;
    at.largest = T(0.0);
    if constexpr (asks_for_largest<Law>) at.largest = largest_principal<T>(points, p) - gap;
    at.rate = rate;
    at.temperature = load<T>(points.stress.temperature + p);
    const T strain = max(fracture_strain(law, at), T(no_ductility));
    const Mask<T> counted = sound & breaks(law, at);
    const T total = select(counted, damage + rate * T(parameters.dt) / strain, damage);
    const Mask<T> reached = counted & initiated(total, softening);
    store(points.damage + p, min(total, T(1.0)));
    if (any(reached))
      store(points.initiation_strain + p, select(reached, load<T>(points.stress.plastic_strain + p),
                                                 load<T>(points.initiation_strain + p)));
  }
  if (any(softens)) {
    const T sound_part = T(1.0) - softening;
    const T spent = load<T>(points.stress.dissipation + p) * load<T>(points.length + p) *
                    T(parameters.by_fracture_energy);
    const T left = max(sound_part * sound_part - spent, T(0.0));
    softening = select(softens, max(T(1.0) - sqrt(left), softening), softening);
    store(points.softening + p, softening);
  }
}

/// Takes `relief` from the pressure and `energy` from the stored energy; P of the mean stress is
/// −p cof F V_stress-free/(V_reference J).
template<int dim, class T>
CNEM_INLINE void relieve_tension(const DamagePoints<dim>& points, std::ptrdiff_t p, T relief, T energy) {
  constexpr int general = StressPoints<dim>::general;
  T f[general], cof[general];
  for (int c = 0; c < general; ++c) f[c] = load<T>(points.stress.deformation[c] + p);
  const T J = cofactor(f, cof);
  const T scaled = relief * load<T>(points.stress.stress_free + p) / J;
  for (int c = 0; c < general; ++c)
    store(points.stress.piola[c] + p, load<T>(points.stress.piola[c] + p) + scaled * cof[c]);
  store(points.stress.pressure + p, load<T>(points.stress.pressure + p) - relief);
  store(points.stress.stored_energy + p, load<T>(points.stress.stored_energy + p) - energy);
}

/// The points p … p + width − 1.
template<int dim, class T, class Law>
CNEM_INLINE void damage_step(const DamageParameters& parameters, const Law& law,
                             const DamagePoints<dim>& points, std::ptrdiff_t p, T& released) {
  T softening = load<T>(points.softening + p);
  const T before = softening, pressure = load<T>(points.stress.pressure + p);
  const T gap =
      select(pressure < T(0.0), min(load<T>(points.opening + p) * T(parameters.kappa), -pressure), T(0.0));
  const T borne = pressure + gap;
  const Mask<T> flowing = load<T>(points.stress.plastic_rate + p) > T(0.0);
  if (parameters.dt > 0.0 && any(flowing))
    accumulate<dim, T>(parameters, law, points, p, flowing, load<T>(points.damage + p), gap, borne,
                       softening);
  if (!parameters.relieves) return;
  const Mask<T> relieved = (pressure < T(0.0)) & ((softening > T(0.0)) | (gap > T(0.0)));
  if (!any(relieved)) return;
  const T energy = borne * borne * T(parameters.by_two_kappa);
  released = released + select(relieved,
                               load<T>(points.volume + p) * load<T>(points.stress.stress_free + p) * energy *
                                   (softening - before),
                               T(0.0));
  const T sound = T(1.0) - softening;
  relieve_tension<dim, T>(
      points, p, select(relieved, pressure - sound * borne, T(0.0)),
      select(relieved, pressure * pressure * T(parameters.by_two_kappa) - sound * energy, T(0.0)));
}

/// The law by value: constants are then known not to change as fields are written.
template<int dim, class Law>
double damage_of(const DamageParameters& parameters, const Law law, const DamagePoints<dim>& points,
                 std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int width = Number<Pack<1>>::width;
  Pack<1> released = 0.0;
  double sum = 0.0;
  std::ptrdiff_t p = begin;
  for (; p + width <= end; p += width) damage_step<dim, Pack<1>>(parameters, law, points, p, released);
  for (; p < end; ++p) damage_step<dim, double>(parameters, law, points, p, sum);
  double lanes[width];
  store(lanes, released);
  for (const double lane : lanes) sum += lane;
  return sum;
}

} // namespace

template<int dim>
double damage(const DamageParameters& parameters, const DamagePoints<dim>& points, std::ptrdiff_t begin,
              std::ptrdiff_t end) {
  return with_law(DamageLaws{}, parameters.law, parameters.constants,
                  [&](const auto& law) { return damage_of(parameters, law, points, begin, end); });
}

template double damage<2>(const DamageParameters&, const DamagePoints<2>&, std::ptrdiff_t, std::ptrdiff_t);
template double damage<3>(const DamageParameters&, const DamagePoints<3>&, std::ptrdiff_t, std::ptrdiff_t);

} // namespace cnem::plasticity::CNEM_ISA
