#include "mechanics/terms/point_damage.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/terms/list.hpp"
#include "plasticity/initiated.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem {

template<int dim>
PointDamage<dim>::PointDamage(const std::vector<plasticity::Material>& materials)
    : active_(std::any_of(materials.begin(), materials.end(),
                          [](const plasticity::Material& material) { return material.damage.has_value(); })),
      average_(materials), table_("solver/point", active_) {}

template<int dim>
void PointDamage<dim>::measure(const DiscreteOperators<dim>& operators,
                               const std::vector<plasticity::Material>& materials,
                               const PointState<dim>& point) {
  const std::size_t n = point.size();
  length_.assign(n, 0.0);
  for (std::size_t p = 0; p < n; ++p) {
    const auto& law = materials[index_of(point.material[p])].damage;
    if (!law) continue;
    double measure = operators.volume[p] * point.stress_free[p];
    if (operators.of_revolution()) measure /= 2.0 * std::numbers::pi * operators.radius[p];
    length_[p] = law->band * (dim == 2 ? std::sqrt(measure) : std::cbrt(measure));
  }
}

template<int dim>
void PointDamage<dim>::weaken(const std::vector<plasticity::Material>& materials, PointState<dim>& point,
                              std::size_t begin, std::size_t end) const {
  for (std::size_t p = begin; p < end; ++p) {
    const plasticity::Material& material = materials[index_of(point.material[p])];
    const double share =
        material.damage ? plasticity::flow_share<dim>(material, point, p, point.pressure[p]) : 1.0;
    point.flow_factor[p] = point.strength[p] * share;
  }
}

template<int dim>
double PointDamage<dim>::update(const DiscreteOperators<dim>& operators,
                                const std::vector<plasticity::Material>& materials, PointState<dim>& point,
                                std::size_t begin, std::size_t end, double dt) const {
  return plasticity::update_damage(materials, point.material,
                                   plasticity::damage_points(point, length_, operators.volume, point.opening),
                                   static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end), dt)
      .released;
}

template<int dim>
void PointDamage<dim>::wave_moduli(const std::vector<plasticity::Material>& materials,
                                   PointState<dim>& point) const {
  constexpr double open = 0.1; // more than closes between two measurements of the step
  for_each_block(point.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const double softening = point.softening[p];
      if (softening == 0.0) continue;
      const plasticity::Material& material = materials[index_of(point.material[p])];
      const plasticity::Elasticity& elasticity = material.elasticity;
      const double opened = point.jacobian[p] / point.stress_free[p];
      const double expansion =
          3.0 * material.expansion * (point.temperature[p] - material.expansion_reference);
      const double bulk = std::log(opened) - expansion > open ? 1.0 - softening : 1.0;
      point.wave_modulus[p] =
          (bulk * elasticity.kappa() + 4.0 / 3.0 * elasticity.mu()) / std::max(opened, 1.0);
    }
  });
}

template<int dim> void PointDamage<dim>::limit(const Body<dim>& body, StepLimit&) {
  if (!active_) return;
  wave_moduli(body.model.materials, body.state.point);
}

template<int dim> void PointDamage<dim>::carried(const Body<dim>& body) {
  if (!active_) return;
  PointState<dim>& point = body.state.point;
  for (std::size_t p = 0; p < point.damage.size(); ++p)
    if (!plasticity::generic::initiated(point.damage[p], point.softening[p]))
      point.initiation_strain[p] = 0.0;
}

template<int dim> void PointDamage<dim>::renew(const Body<dim>& body) {
  if (!active_) return;
  PointState<dim>& point = body.state.point;
  measure(body.operators(), body.model.materials, point);
  update(body.operators(), body.model.materials, point, 0, point.size(), 0.0);
}

template<int dim> void PointDamage<dim>::attach(const Body<dim>& body) {
  if (average_.active()) average_.list(body.operators(), body.state.node.reference, body.state.point);
}

template<int dim> void PointDamage<dim>::begin_stress(const Body<dim>& body, const DuePoints& due) {
  if (average_.active()) average_.begin(body.state.point);
  sums_.assign(due.ranges.size(), 0.0);
}

template<int dim> void PointDamage<dim>::before_stress(const Body<dim>& body, const LevelRange& range) {
  if (active_) weaken(body.model.materials, body.state.point, range.begin, range.end);
}

template<int dim>
void PointDamage<dim>::after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) {
  if (!active_) return;
  sums_[due.index(range)] = update(body.operators(), body.model.materials, body.state.point, range.begin,
                                   range.end, due.own(range));
}

template<int dim> void PointDamage<dim>::end_stress(const Body<dim>& body, const DuePoints&) {
  if (average_.active()) average_.share(body.state.point);
  for (const double energy : sums_) released_.value += energy;
}

template<int dim> std::unique_ptr<Term<dim>> point_damage(const Model<dim>& model) {
  return std::make_unique<PointDamage<dim>>(model.materials);
}

template std::unique_ptr<Term<2>> point_damage(const Model<2>&);
template std::unique_ptr<Term<3>> point_damage(const Model<3>&);
template class PointDamage<2>;
template class PointDamage<3>;

} // namespace cnem
