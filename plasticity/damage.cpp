#include "plasticity/damage.hpp"

#include "core/machine/isa.hpp"
#include "plasticity/return_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::plasticity {

double JohnsonCookDamage::fracture_strain(double triaxiality, double rate, double temperature) const {
  const double homologous = std::clamp((temperature - T0) / (Tmelt - T0), 0.0, 1.0);
  return (D1 + D2 * std::exp(D3 * triaxiality)) * (1.0 + D4 * std::log(std::max(rate / rate0, 1.0))) *
         (1.0 + D5 * homologous);
}

namespace {

DamageParameters damage_parameters(const Material& material, double dt, bool relieves) {
  const Damage& damage = *material.damage;
  return {static_cast<int>(damage.law.index()),
          std::visit([](const auto& law) { return static_cast<const void*>(&law); }, damage.law),
          1.0 / damage.fracture_energy,
          material.elasticity.kappa(),
          0.5 / material.elasticity.kappa(),
          dt,
          relieves};
}

template<int dim>
double on_active_isa(const DamageParameters& parameters, const DamagePoints<dim>& points,
                     std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(damage(parameters, points, begin, end));
}

} // namespace

template<int dim>
double flow_share(const Material& material, const PointState<dim>& point, std::size_t p, double pressure) {
  const Damage& damage = *material.damage;
  const double softening = point.softening[p];
  double rubbing = 0.0;
  if (damage.friction > 0.0 && softening > 0.0 && pressure > 0.0 && material.hardening) {
    const double sound =
        point.strength[p] *
        material.hardening->flow_stress(point.plastic_strain[p], point.plastic_rate[p], point.temperature[p]);
    const double strength = std::numbers::sqrt3 * damage.friction * pressure;
    rubbing = strength < sound ? strength / sound : 1.0;
  }
  return damage.flow_share(softening, rubbing);
}

template<int dim>
DamagePoints<dim> damage_points(PointState<dim>& state, const Field& length, const Field& volume,
                                const Field& opening) {
  return {stress_points(state),
          length.data(),
          volume.data(),
          opening.data(),
          state.damage.data(),
          state.softening.data(),
          state.initiation_strain.data()};
}

template<int dim>
DamageSums update_damage(const std::vector<Material>& materials, const std::vector<std::int32_t>& material,
                         const DamagePoints<dim>& points, std::ptrdiff_t begin, std::ptrdiff_t end,
                         double dt) {
  DamageSums sums;
  for_each_run(materials, material, begin, end,
               [&](const Material& own, std::ptrdiff_t p, std::ptrdiff_t stop) {
                 if (own.damage)
                   sums.released +=
                       on_active_isa(damage_parameters(own, dt, !points.stress.thickness), points, p, stop);
               });
  return sums;
}

template double flow_share(const Material&, const PointState<2>&, std::size_t, double);
template double flow_share(const Material&, const PointState<3>&, std::size_t, double);
template DamagePoints<2> damage_points(PointState<2>&, const Field&, const Field&, const Field&);
template DamagePoints<3> damage_points(PointState<3>&, const Field&, const Field&, const Field&);
template DamageSums update_damage(const std::vector<Material>&, const std::vector<std::int32_t>&,
                                  const DamagePoints<2>&, std::ptrdiff_t, std::ptrdiff_t, double);
template DamageSums update_damage(const std::vector<Material>&, const std::vector<std::int32_t>&,
                                  const DamagePoints<3>&, std::ptrdiff_t, std::ptrdiff_t, double);

} // namespace cnem::plasticity
