#include "mechanics/terms/point_damage.hpp"

#include "core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem {

template<int dim>
PointDamage<dim>::PointDamage(const std::vector<plasticity::Material>& materials)
    : active_(std::any_of(materials.begin(), materials.end(),
                          [](const plasticity::Material& material) { return material.damage.has_value(); })) {
  for (const plasticity::Material& material : materials)
    law_.push_back(material.damage.value_or(plasticity::JohnsonCookDamage{}));
}

template<int dim> void PointDamage<dim>::start(PointState<dim>& point) {
  if (!active_) return;
  opening_.assign(point.size(), 0.0);
  for (Field* field : {&point.damage, &point.softening, &point.initiation_strain})
    field->assign(point.size(), 0.0);
}

template<int dim>
void PointDamage<dim>::measure(const DiscreteOperators<dim>& operators,
                               const std::vector<plasticity::Material>& materials,
                               const PointState<dim>& point) {
  if (!active_) return;
  const std::size_t n = point.size();
  length_.assign(n, 0.0);
  for (std::size_t p = 0; p < n; ++p) {
    const auto& law = materials[static_cast<std::size_t>(point.material[p])].damage;
    if (!law) continue;
    double measure = operators.volume[p] * point.stress_free[p];
    if (operators.of_revolution()) measure /= 2.0 * std::numbers::pi * operators.radius[p];
    length_[p] = law->band * (dim == 2 ? std::sqrt(measure) : std::cbrt(measure));
  }
}

template<int dim> void PointDamage<dim>::weaken(const PointState<dim>& point) {
  if (!active_) return;
  flow_factor_.resize(point.size());
  weaken(point, 0, point.size());
}

template<int dim>
void PointDamage<dim>::weaken(const PointState<dim>& point, std::size_t begin, std::size_t end) {
  for (std::size_t p = begin; p < end; ++p)
    flow_factor_[p] =
        point.strength[p] * law_[static_cast<std::size_t>(point.material[p])].flow_share(point.softening[p]);
}

template<int dim>
double PointDamage<dim>::update(const DiscreteOperators<dim>& operators,
                                const std::vector<plasticity::Material>& materials, PointState<dim>& point,
                                std::size_t begin, std::size_t end, double dt) const {
  return plasticity::update_damage(materials, point.material,
                                   plasticity::damage_points(point, length_, operators.volume, opening_),
                                   static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end), dt)
      .released;
}

template<int dim>
void PointDamage<dim>::wave_moduli(const std::vector<plasticity::Material>& materials,
                                   const PointState<dim>& point, const Field& jacobian,
                                   Field& wave_modulus) const {
  constexpr double open = 0.1; // more than closes between two measurements of the step
  if (!active_) return;
  for_each_block(point.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const double softening = point.softening[p];
      if (softening == 0.0) continue;
      const plasticity::Material& material = materials[static_cast<std::size_t>(point.material[p])];
      const plasticity::Elasticity& elasticity = material.elasticity;
      const double opened = jacobian[p] / point.stress_free[p];
      const double expansion =
          3.0 * material.expansion * (point.temperature[p] - material.expansion_reference);
      const double bulk = std::log(opened) - expansion > open ? 1.0 - softening : 1.0;
      wave_modulus[p] = (bulk * elasticity.kappa() + 4.0 / 3.0 * elasticity.mu()) / std::max(opened, 1.0);
    }
  });
}

template<int dim> void PointDamage<dim>::archive(Archive& archive, std::size_t points) {
  if (!active_) return;
  length_.resize(points);
  flow_factor_.resize(points);
  opening_.resize(points);
  archive.field("solver/point/damage_opening", "1", opening_);
  archive.field("solver/point/damage_length", "m", length_);
}

template class PointDamage<2>;

} // namespace cnem
