#include "core/simd.hpp"
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
                            Mask<T> flowing, T damage, T& softening) {
  const T rate = load<T>(points.plastic_rate + p);
  const Mask<T> sound = flowing & (damage < T(1.0)), initiated = flowing & (damage >= T(1.0));
  if (any(sound)) {
    const T triaxiality =
        -load<T>(points.pressure + p) / max(load<T>(points.equivalent_stress + p), T(1e-100));
    const T strain = fracture_strain(law, triaxiality, rate, load<T>(points.temperature + p));
    const Mask<T> counted = sound & (triaxiality > T(law.cut_off));
    const T total = select(counted, damage + rate * T(law.dt) / strain, damage);
    const Mask<T> reached = counted & (total >= T(1.0));
    store(points.damage + p, min(total, T(1.0)));
    if (any(reached))
      store(points.initiation_strain + p,
            select(reached, load<T>(points.plastic_strain + p), load<T>(points.initiation_strain + p)));
  }
  if (any(initiated)) {
    const T sound_part = T(1.0) - softening;
    const T spent = load<T>(points.dissipation + p) * load<T>(points.length + p) * T(law.by_fracture_energy);
    const T left = max(sound_part * sound_part - spent, T(0.0));
    softening = select(initiated, max(T(1.0) - sqrt(left), softening), softening);
    store(points.softening + p, softening);
  }
}

/// Lowers tension by 1 − ω; P of the mean stress is −p cof F V_stress-free/(V_reference J).
template<int dim, class T>
CNEM_INLINE void relieve_tension(const DamagePoints<dim>& points, std::ptrdiff_t p, Mask<T> in_tension,
                                 T softening, T pressure, T energy) {
  T f[DamagePoints<dim>::general], cofactor[DamagePoints<dim>::general], J;
  for (int c = 0; c < DamagePoints<dim>::general; ++c) f[c] = load<T>(points.deformation[c] + p);
  if constexpr (dim == 2) {
    const T plane = f[0] * f[3] - f[1] * f[2];
    J = plane * f[4];
    cofactor[0] = f[3] * f[4];
    cofactor[1] = -f[2] * f[4];
    cofactor[2] = -f[1] * f[4];
    cofactor[3] = f[0] * f[4];
    cofactor[4] = plane;
  } else {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (k + 1) % 3, d = (k + 2) % 3;
        cofactor[i * 3 + k] = f[a * 3 + c] * f[b * 3 + d] - f[a * 3 + d] * f[b * 3 + c];
      }
    J = f[0] * cofactor[0] + f[1] * cofactor[1] + f[2] * cofactor[2];
  }
  const T relief = select(in_tension, softening * pressure, T(0.0));
  const T scaled = relief * load<T>(points.stress_free + p) / J;
  for (int c = 0; c < DamagePoints<dim>::general; ++c)
    store(points.piola[c] + p, load<T>(points.piola[c] + p) + scaled * cofactor[c]);
  store(points.pressure + p, pressure - relief);
  store(points.stored_energy + p,
        load<T>(points.stored_energy + p) - select(in_tension, softening * energy, T(0.0)));
}

/// The points p … p + width − 1.
template<int dim, class T>
CNEM_INLINE void damage_step(const DamageParameters& law, const DamagePoints<dim>& points, std::ptrdiff_t p,
                             T& released) {
  T softening = load<T>(points.softening + p);
  const T before = softening;
  const Mask<T> flowing = load<T>(points.plastic_rate + p) > T(0.0);
  if (law.dt > 0.0 && any(flowing))
    accumulate<dim, T>(law, points, p, flowing, load<T>(points.damage + p), softening);
  if (!any(softening > T(0.0))) return;
  const T pressure = load<T>(points.pressure + p);
  const Mask<T> in_tension = (softening > T(0.0)) & (pressure < T(0.0));
  if (!any(in_tension)) return;
  const T energy = pressure * pressure * T(law.by_two_kappa);
  released = released + select(in_tension,
                               load<T>(points.volume + p) * load<T>(points.stress_free + p) * energy *
                                   (softening - before),
                               T(0.0));
  relieve_tension<dim, T>(points, p, in_tension, softening, pressure, energy);
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
