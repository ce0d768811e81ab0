// What goes over to the nodes of a resampled cloud: each field by the rule of its line.
#include "mechanics/explicit_solver.hpp"
#include "mechanics/mixing.hpp"

namespace cnem {

/// Expects b_e in place of C_p⁻¹ (push_forward).
template<int dim> void ExplicitSolver<dim>::carry_over(const Resampling<dim>& change) {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const std::size_t n = change.cloud.position.size();
  const CarryWeights weights{.parcels = change.parcels,
                             .labels = change.labels,
                             .mass = node.mass,
                             .inertia = node.inertia(),
                             // without heat there may be no capacity
                             .capacity = model_.thermal ? node.heat_capacity : node.mass};
  Field tension;
  std::vector<FieldTable*> tables = node_tables();
  if (!change.points_stay) {
    tension = held_tension(model_.materials, point);
    if (!tension.empty()) carry_mean(change.parcels, weights.mass, tension);
    for (FieldTable* table : point_tables()) tables.push_back(table);
  }
  for (FieldTable* table : tables) {
    table->carry_over(weights);
    table->rest_renewed(n);
  }
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < n; ++i)
      node.position[k][i] = change.cloud.position[i][static_cast<Eigen::Index>(k)];
  node.velocity_before = node.velocity;
  conditions_.ties.resample(change);
  conditions_.heat_ties.resample(change);
  if (!conditions_.heat_ties.empty()) conditions_.heat_ties.share(node.heat_capacity, node.temperature);
  point.temperature = node.temperature;
  set_moduli();
  each([&](Term<dim>& term) { term.carried(body()); });
  if (!change.points_stay) mix_elastic(change, weights.mass, tension, model_.materials, point);
  if (local_.on()) local_.follow(change.labels);
  start_weight_.clear();
  conditions_.supports.resample(change, conditions_.ties);
  conditions_.loads.resample(change.cloud, node.initial_position);
  conditions_.heat_boundaries.resample(change, [&](std::vector<NodeIndex> nodes) {
    return conditions_.heat_ties.with_partners(std::move(nodes));
  });
}

template void ExplicitSolver<2>::carry_over(const Resampling<2>&);
template void ExplicitSolver<3>::carry_over(const Resampling<3>&);

} // namespace cnem
