#include "core/cofactor.hpp"
#include "core/machine/simd.hpp"
#include "plasticity/damage_points.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

namespace {

/// A fracture strain that the law puts at or below 0 means initiation with the first flow.
constexpr double no_ductility = 1e-12;

template<class T>
CNEM_INLINE T fracture_strain(const DamageParameters& law, T triaxiality, T rate, T temperature) {
  const T exponent = min(max(T(law.D3) * triaxiality, T(-700.0)), T(700.0));
  T strain = T(law.D1) + T(law.D2) * exp(exponent);
  if (law.D4 != 0.0) strain = strain * (T(1.0) + T(law.D4) * log(max(rate * T(law.by_rate0), T(1.0))));
  const T homologous = min(max((temperature - T(law.T0)) * T(law.by_melting_range), T(0.0)), T(1.0));
  strain = strain * (T(1.0) + T(law.D5) * homologous);
  return max(strain, T(no_ductility));
}

/// D, ω and the strain at initiation of the points that flow.
template<int dim, class T>
CNEM_INLINE void accumulate(const DamageParameters& law, const DamagePoints<dim>& points, std::ptrdiff_t p,
                            Mask<T> flowing, T damage, T pressure, T& softening) {
  const T rate = load<T>(points.stress.plastic_rate + p);
  const Mask<T> sound = flowing & (damage < T(1.0)), initiated = flowing & (damage >= T(1.0));
  if (any(sound)) {
    const T triaxiality = -pressure / max(load<T>(points.stress.equivalent_stress + p), T(1e-100));
    const T strain = fracture_strain(law, triaxiality, rate, load<T>(points.stress.temperature + p));
    const Mask<T> counted = sound & (triaxiality > T(law.cut_off));
    const T total = select(counted, damage + rate * T(law.dt) / strain, damage);
    const Mask<T> reached = counted & (total >= T(1.0));
    store(points.damage + p, min(total, T(1.0)));
    if (any(reached))
      store(points.initiation_strain + p, select(reached, load<T>(points.stress.plastic_strain + p),
                                                 load<T>(points.initiation_strain + p)));
  }
  if (any(initiated)) {
    const T sound_part = T(1.0) - softening;
    const T spent =
        load<T>(points.stress.dissipation + p) * load<T>(points.length + p) * T(law.by_fracture_energy);
    const T left = max(sound_part * sound_part - spent, T(0.0));
    softening = select(initiated, max(T(1.0) - sqrt(left), softening), softening);
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
template<int dim, class T>
CNEM_INLINE void damage_step(const DamageParameters& law, const DamagePoints<dim>& points, std::ptrdiff_t p,
                             T& released) {
  T softening = load<T>(points.softening + p);
  const T before = softening, pressure = load<T>(points.stress.pressure + p);
  const T gap = select(pressure < T(0.0), min(load<T>(points.opening + p) * T(law.kappa), -pressure), T(0.0));
  const T borne = pressure + gap;
  const Mask<T> flowing = load<T>(points.stress.plastic_rate + p) > T(0.0);
  if (law.dt > 0.0 && any(flowing))
    accumulate<dim, T>(law, points, p, flowing, load<T>(points.damage + p), borne, softening);
  const Mask<T> relieved = (pressure < T(0.0)) & ((softening > T(0.0)) | (gap > T(0.0)));
  if (!any(relieved)) return;
  const T energy = borne * borne * T(law.by_two_kappa);
  released = released + select(relieved,
                               load<T>(points.volume + p) * load<T>(points.stress.stress_free + p) * energy *
                                   (softening - before),
                               T(0.0));
  const T sound = T(1.0) - softening;
  relieve_tension<dim, T>(
      points, p, select(relieved, pressure - sound * borne, T(0.0)),
      select(relieved, pressure * pressure * T(law.by_two_kappa) - sound * energy, T(0.0)));
}

} // namespace

template<int dim>
double damage(const DamageParameters& parameters, const DamagePoints<dim>& points, std::ptrdiff_t begin,
              std::ptrdiff_t end) {
  constexpr int width = Number<Pack<1>>::width;
  Pack<1> released = 0.0;
  double sum = 0.0;
  std::ptrdiff_t p = begin;
  for (; p + width <= end; p += width) damage_step<dim, Pack<1>>(parameters, points, p, released);
  for (; p < end; ++p) damage_step<dim, double>(parameters, points, p, sum);
  double lanes[width];
  store(lanes, released);
  for (const double lane : lanes) sum += lane;
  return sum;
}

template double damage<2>(const DamageParameters&, const DamagePoints<2>&, std::ptrdiff_t, std::ptrdiff_t);
template double damage<3>(const DamageParameters&, const DamagePoints<3>&, std::ptrdiff_t, std::ptrdiff_t);

} // namespace cnem::plasticity::CNEM_ISA
