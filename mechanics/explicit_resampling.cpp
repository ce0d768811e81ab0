// What goes over to the nodes of a resampled cloud and to new stress points: each field by the rule of its
// line.
#include "core/index.hpp"
#include "mechanics/boundary_parting.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/mixing.hpp"
#include "mechanics/node_heat.hpp"
#include "mechanics/ply_mixing.hpp"
#include "mechanics/statics/rigid_motion.hpp"

#include <cassert>

namespace cnem {

namespace {

/// Whether no point is made of the matter of two materials.
[[maybe_unused]] bool keeps_materials_apart(const PointRows& parcels, const LabelField& material) {
  for (std::size_t p = 0; p < parcels.size(); ++p) {
    const auto first = index_of(parcels.begin[p]), last = index_of(parcels.begin[p + 1]);
    for (std::size_t e = first; e < last; ++e)
      if (material[index_of(parcels.from[e])] != material[index_of(parcels.from[first])]) return false;
  }
  return true;
}

} // namespace

/// How points go over to a new reference with these operators; none where they stay what they are.
template<int dim>
std::optional<typename ExplicitSolver<dim>::PointChange>
ExplicitSolver<dim>::change_of_points(const Resampling<dim>* change, const Cloud<dim>& cloud,
                                      const DiscreteOperators<dim>& now) const {
  if (change && !change->points_stay) {
    require(model_.method->promises(), Promise::one_point_per_node, model_.method->name(), "resampling");
    return PointChange{rows_of_points(change->parcels), rows_of_points(change->labels)};
  }
  std::optional<PointRows> parcels = model_.method->point_parcels(approximation_->mechanics, now, cloud);
  if (!parcels) return std::nullopt;
  assert(keeps_materials_apart(*parcels, state_.point.material));
  PointRows labels = *parcels;
  return PointChange{std::move(*parcels), std::move(labels)};
}

/// What a point carries, kg/m^(3−dim): ρ0 times its stress-free volume; the mass of its node where it has
/// one.
template<int dim> double ExplicitSolver<dim>::point_mass(std::size_t p) const {
  const DiscreteOperators<dim>& op = approximation_->mechanics;
  if (op.nodal) return state_.node.mass[p];
  return body().material_of(p).density * op.volume[p] * state_.point.stress_free[p];
}

/// Expects b_e in place of C_p⁻¹ (push_forward). now: the operators of the new reference.
template<int dim>
void ExplicitSolver<dim>::carry_over(const Resampling<dim>* change, const std::optional<PointChange>& points,
                                     const DiscreteOperators<dim>& now) {
  PointState<dim>& point = state_.point;
  Field mass(points ? point.size() : 0);
  for (std::size_t p = 0; p < mass.size(); ++p) mass[p] = point_mass(p);
  Field tension = points ? held_tension(model_.materials, point) : Field();
  if (points) to_present_thickness(point);
  const PlyDeformation<dim> plies =
      points ? mixed_plies(points->parcels, mass, model_.materials, model_.plane_stress, point)
             : PlyDeformation<dim>();
  if (change) carry_nodes(*change);
  if (points) {
    for (FieldTable* table : point_tables()) {
      table->carry_over(CarryWeights<PointIndex>{points->parcels, points->labels, mass});
      table->rest_renewed(points->parcels.size());
    }
    if (!tension.empty()) carry_mean(points->parcels, mass, tension);
  }
  interpolate<dim>(now, state_.node.temperature, point.temperature, 0, point.size());
  set_moduli();
  if (points) {
    Field elastic_volume;
    if (!now.nodal) {
      elastic_volume = mass;
      carry_sum(points->parcels, elastic_volume);
      for (std::size_t p = 0; p < point.size(); ++p)
        elastic_volume[p] = body().material_of(p).density * now.volume[p] / elastic_volume[p];
    }
    mix_elastic(points->parcels, mass, tension, elastic_volume, model_.materials, point);
    to_initial_thickness(point);
    set_plies(plies, elastic_volume, point);
    draw_back_plies(plies, model_.materials, point);
  }
  if (change && change->open()) rest_virgin(*change);
  each([&](Term<dim>& term) { term.carried(body()); });
}

/// Points of virgin matter are at rest; what terms keep at them is as at the nodes that they take after.
template<int dim> void ExplicitSolver<dim>::rest_virgin(const Resampling<dim>& change) {
  PointState<dim>& point = state_.point;
  for (const NodeIndex node : change.virgin) {
    const auto p = index_of(point_of(node));
    for (FieldTable* table : point.tables()) table->rest_at(p);
    start_flow_stress(p);
  }
}

template<int dim> void ExplicitSolver<dim>::carry_nodes(const Resampling<dim>& change) {
  NodeState<dim>& node = state_.node;
  const std::size_t n = change.cloud.position.size();
  to_enthalpy<dim>(model_, node);
  const CarryWeights<NodeIndex> weights{.parcels = change.parcels,
                                        .labels = change.labels,
                                        .mass = node.mass,
                                        .inertia = node.inertia(),
                                        // without heat there may be no capacity
                                        .capacity = model_.thermal ? node.heat_capacity : node.mass};
  for (FieldTable* table : node_tables()) {
    table->carry_over(weights);
    table->rest_renewed(n);
  }
  to_temperature<dim>(model_, node);
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < n; ++i)
      node.position[k][i] = change.cloud.position[i][static_cast<Eigen::Index>(k)];
  for (const NodeIndex virgin : change.virgin) {
    const auto i = index_of(virgin);
    node.temperature[i] = node.initial_temperature[i];
    for (std::size_t k = 0; k < dim; ++k) node.initial_position[k][i] = node.position[k][i];
  }
  node.velocity_before = node.velocity;
  conditions_.ties.resample(change);
  conditions_.heat_ties.resample(change);
  if constexpr (dim == 2) conditions_.cohesive.resample(change);
  share_heat<dim>(model_, conditions_.heat_ties, node);
  if (local_.on() && !change.points_stay) local_.follow(change.labels);
  start_weight_.clear();
  conditions_.supports.resample(change, conditions_.ties);
  conditions_.loads.resample(change.cloud, node.initial_position);
  conditions_.heat_boundaries.resample(change, [&](std::vector<NodeIndex> nodes) {
    return conditions_.heat_ties.with_partners(std::move(nodes));
  });
}

template<int dim> std::string ExplicitSolver<dim>::part_faces() requires(dim == 2) {
  if (conditions_.cohesive.empty()) return "";
  conditions_.cloud.body.clear();
  for (const std::size_t first : parts_of(approximation_->mechanics, state_.node.size()))
    conditions_.cloud.body.push_back(as<std::int32_t>(first));
  const CohesiveInterface* left =
      conditions_.cohesive.part(conditions_.cloud, state_.node.position); // with their offsets
  part_boundary(conditions_.cloud, state_.node.position);
  conditions_.contact.set_bonds(conditions_.cohesive.bonds(conditions_.cloud));
  return left ? left->spec.name : "";
}

template std::string ExplicitSolver<2>::part_faces();
#define CNEM_INSTANTIATE(dim)                                                                                \
  template std::optional<ExplicitSolver<dim>::PointChange> ExplicitSolver<dim>::change_of_points(            \
      const Resampling<dim>*, const Cloud<dim>&, const DiscreteOperators<dim>&) const;                       \
  template double ExplicitSolver<dim>::point_mass(std::size_t) const;                                        \
  template void ExplicitSolver<dim>::carry_over(const Resampling<dim>*, const std::optional<PointChange>&,   \
                                                const DiscreteOperators<dim>&);                              \
  template void ExplicitSolver<dim>::carry_nodes(const Resampling<dim>&);                                    \
  template void ExplicitSolver<dim>::rest_virgin(const Resampling<dim>&);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
