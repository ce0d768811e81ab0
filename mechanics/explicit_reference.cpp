// A solver's start and its references: cells, functions and everything that belongs to them.
#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/ply_mixing.hpp"
#include "plasticity/return_map.hpp"
#include "thermal/conduction.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

template<int dim>
ExplicitSolver<dim>::ExplicitSolver(Problem<dim> problem, Fields<dim> velocity, Field temperature)
    : model_(std::move(static_cast<Model<dim>&>(problem))),
      conditions_(std::move(static_cast<Conditions<dim>&>(problem))), terms_(make_terms(model_)),
      local_(model_.local) {
  NodeState<dim>& node = state_.node;
  const auto n = index_of(conditions_.cloud.nodes());
  node.scaling.switch_on(model_.mass_scaling.active());
  state_.point.damaged.switch_on(
      std::any_of(model_.materials.begin(), model_.materials.end(),
                  [](const plasticity::Material& material) { return material.damage.has_value(); }));
  state_.point.oriented.switch_on(
      std::any_of(model_.materials.begin(), model_.materials.end(), [](const plasticity::Material& material) {
        return material.anisotropy.has_value() || material.ply.has_value();
      }));
  state_.point.fibrous.switch_on(
      std::any_of(model_.materials.begin(), model_.materials.end(),
                  [](const plasticity::Material& material) { return material.ply.has_value(); }));
  state_.point.flowing.switch_on(
      std::any_of(model_.materials.begin(), model_.materials.end(), [](const plasticity::Material& material) {
        return material.ply.has_value() && material.hardening.has_value();
      }));
  state_.point.failing.switch_on(
      std::any_of(model_.materials.begin(), model_.materials.end(),
                  [](const plasticity::Material& material) { return material.failure.has_value(); }));
  state_.point.thin.switch_on(model_.plane_stress);
  state_.point.traded.switch_on(model_.pressure_exchange > 0.0 || model_.stress_annealing > 0.0);
  for (FieldTable* table : node_tables()) table->rest(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < dim; ++k)
      node.position[k][i] = conditions_.cloud.position[i][static_cast<Eigen::Index>(k)];
  node.initial_position = node.position;
  node.velocity_before = node.velocity = std::move(velocity);
  node.initial_temperature = node.temperature = std::move(temperature);
  if (!problem.node_material.empty()) node.material = std::move(problem.node_material);
  if (!problem.strength.empty()) node.strength = std::move(problem.strength);
  prepare();
  share_velocities();
  initial_energy_ = ledger().total();
}

template<int dim> Cloud<dim> ExplicitSolver<dim>::present_cloud() const {
  Cloud<dim> cloud = conditions_.cloud;
  for (std::size_t i = 0; i < state_.node.position[0].size(); ++i)
    for (std::size_t k = 0; k < dim; ++k)
      cloud.position[i][static_cast<Eigen::Index>(k)] = state_.node.position[k][i];
  return cloud;
}

template<int dim> void ExplicitSolver<dim>::prepare() { renew(present_cloud(), nullptr); }

template<int dim> void ExplicitSolver<dim>::prepare(const Resampling<dim>& change) {
  renew(change.cloud, &change);
}

template<int dim> void ExplicitSolver<dim>::renew(Cloud<dim> cloud, const Resampling<dim>* change) {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  if (references_ > 0)
    require(model_.method->promises(), Promise::carried_history, model_.method->name(), "a new reference");
  release();
  Approximation<dim> rebuilt;
  std::optional<PointChange> points_change;
  try {
    rebuilt = model_.method->rebuild_rows(cloud);
    if constexpr (dim == 3) cloud.simplices = {}, cloud.across = {}; // before nodes move
    if (references_ > 0) points_change = change_of_points(change, cloud, rebuilt.mechanics);
  } catch (...) {
    if (references_ > 0) regain();
    throw;
  }
  Booked booked;
  if (references_ > 0) {
    each([&](Term<dim>& term) { term.leave(body()); });
    if (change && change->open()) each([&](Term<dim>& term) { term.exchange(body(), *change, booked); });
    push_forward(point);
    let_go_of_shear(model_.materials, point);
  }
  if (change || points_change) carry_over(change, points_change, rebuilt.mechanics);
  conditions_.cloud = std::move(cloud);
  *approximation_ = std::move(rebuilt);
  if (approximation_->mechanics.point.empty()) approximation_->mechanics.build_transpose();
  node.reference = node.position;
  if (references_ == 0) start_points();
  place_reference();
  const std::size_t points = point.size();
  const LevelRange all{0, points, 0, false};
  for (std::size_t k = 0; k < point.deformation.size(); ++k)
    point.deformation[k].assign(points, rest_unit_general<dim>[k]);
  point.jacobian.assign(points, 1.0);
  if (references_ == 0 || change) choose_mass_factors();
  scale_masses();
  if (change) {
    share_velocities();
    node.velocity_before = node.velocity;
  }
  each([&](Term<dim>& term) { term.before_stress(body(), all); });
  const std::ptrdiff_t bad =
      plasticity::update_stress(model_.materials, point.material, plasticity::stress_points(point), 0,
                                static_cast<std::ptrdiff_t>(points), 0.0);
  if (bad >= 0) diverged(index_of(bad), "elastic strain");
  each([&](Term<dim>& term) { term.stressed(body(), booked); });
  each([&](Term<dim>& term) { term.renew(body()); });
  for (std::size_t p = 0; p < points; ++p)
    point.density[p] = body().material_of(p).density * point.stress_free[p];
  each([&](Term<dim>& term) { term.attach(body()); });
  copy_stress_columns<dim>(point.piola, stress_);
  rebuild_levels();
  bound_.forget();
  // what nodes exchange by the points of a reference follows it, and makes none of its own
  if (!(change && change->points_stay && points_change)) ++references_;
  if (change) ++resamplings_;
  each([&](Term<dim>& term) { term.settle(body(), change || points_change, booked); });
}

/// Lets go of what steps alone read and `regain` makes again, to the bit: a fifth of the memory at its peak
/// while operators are rebuilt.
template<int dim> void ExplicitSolver<dim>::release() {
  DiscreteOperators<dim>& op = approximation_->mechanics;
  op.point = {};
  op.weighted_gradient = {};
  reference_ = position_ = Field();
  stress_ = {};
  bound_.release();
  each([&](Term<dim>& term) { term.release(); });
}

/// As after a checkpoint, whose operators are these.
template<int dim> void ExplicitSolver<dim>::regain() {
  approximation_->mechanics.build_transpose();
  place_reference();
  each([&](Term<dim>& term) { term.attach(body()); });
}

/// What gathering passes read, on a new reference.
template<int dim> void ExplicitSolver<dim>::place_reference() {
  reference_ = side_by_side<dim>(state_.node.reference);
  position_ = side_by_side<dim>(state_.node.position);
  copy_stress_columns<dim>(state_.point.piola, stress_);
}

template<int dim> double ExplicitSolver<dim>::wanted_step() const {
  const MassScaling& scaling = model_.mass_scaling;
  if (scaling.cell <= 0.0) return scaling.step;
  double fastest = 0.0; // m²/s²
  for (const plasticity::Material& material : model_.materials)
    fastest = std::max(fastest, material.wave_modulus(model_.plane_stress) / material.density);
  return 2.0 * model_.safety * scaling.cell / std::sqrt(fastest);
}

/// Factors on masses: those of a step follow the cells of each cloud, others stay. Nodes keep their speed,
/// and what inertia is added has it too.
template<int dim> void ExplicitSolver<dim>::choose_mass_factors() {
  const MassScaling& scaling = model_.mass_scaling;
  NodeState<dim>& node = state_.node;
  if (!scaling.active() || !model_.mechanical) return;
  if (!scaling.wants_step()) {
    node.mass_scale.assign(node.size(), scaling.factor);
    return;
  }
  const double omega = 2.0 * model_.safety / wanted_step();
  StepLimit limit;
  each([&](Term<dim>& term) { term.limit(body(), limit); });
  const PointState<dim>& point = state_.point;
  const bool first = references_ == 0;
  const int rounds = first ? 8 : 0; // the step in use is the stable one whatever they come to
  Field factor = scales_for_frequency(approximation_->mechanics, point.deformation, point.wave_modulus,
                                      node.mass, omega * omega / (1.0 + limit.stabilisation), rounds);
  constexpr double of_bonds = 0.1; // what they may add to the square of the highest frequency
  Field rows(node.size(), 0.0);
  each([&](Term<dim>& term) { term.stiffen(body(), rows); });
  for (std::size_t i = 0; i < node.size(); ++i)
    factor[i] = std::max(factor[i], rows[i] / (node.mass[i] * of_bonds * omega * omega));
  if (!first)
    for (std::size_t i = 0; i < node.size(); ++i)
      for (std::size_t k = 0; k < dim; ++k)
        scaling_momentum_[static_cast<Eigen::Index>(k)] +=
            (factor[i] - node.mass_scale[i]) * node.mass[i] * node.velocity[k][i];
  node.mass_scale = std::move(factor);
}

template<int dim> void ExplicitSolver<dim>::scale_masses() {
  NodeState<dim>& node = state_.node;
  if (!node.scaling.on() || !model_.mechanical) return;
  for (std::size_t i = 0; i < node.size(); ++i) node.scaled_mass[i] = node.mass_scale[i] * node.mass[i];
}

template<int dim> std::vector<FieldTable*> ExplicitSolver<dim>::node_tables() {
  return {&state_.node.table, &state_.node.scaling};
}

/// Those of the state and of the terms.
template<int dim> std::vector<FieldTable*> ExplicitSolver<dim>::point_tables() {
  std::vector<FieldTable*> tables = state_.point.tables();
  each([&](Term<dim>& term) {
    if (FieldTable* table = term.fields()) tables.push_back(table);
  });
  return tables;
}

/// Tied nodes move as one from the start.
template<int dim> void ExplicitSolver<dim>::share_velocities() {
  NodeState<dim>& node = state_.node;
  if (conditions_.ties.empty()) return;
  for (Field& component : node.velocity) conditions_.ties.share(node.inertia(), component);
}

/// Masses, and stress points at rest.
template<int dim> void ExplicitSolver<dim>::start_points() {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const DiscreteOperators<dim>& op = approximation_->mechanics;
  const auto points = index_of(op.points);
  node.mass = op.node_volume();
  for (std::size_t i = 0; i < node.mass.size(); ++i) {
    const plasticity::Material& material = body().material_of_node(as<NodeIndex>(i));
    node.mass[i] *= material.density;
    node.heat_capacity[i] = node.mass[i] * material.specific_heat;
  }
  for (FieldTable* table : point_tables()) table->rest(points);
  interpolate<dim>(op, node.temperature, point.temperature, 0, points);
  if (std::any_of(node.strength.begin(), node.strength.end(), [](double s) { return s != 1.0; }))
    interpolate<dim>(op, node.strength, point.strength, 0, points);
  for (std::size_t p = 0; p < points; ++p) point.material[p] = node.material[index_of(op.first_node(p))];
  set_moduli();
  for (std::size_t p = 0; p < points; ++p) start_flow_stress(p);
  each([&](Term<dim>& term) { term.start(body()); });
}

template<int dim> void ExplicitSolver<dim>::start_flow_stress(std::size_t p) {
  PointState<dim>& point = state_.point;
  if (const auto& hardening = body().material_of(p).hardening)
    point.flow_stress[p] = point.strength[p] * hardening->flow_stress(0.0, 0.0, point.temperature[p]);
}

template<int dim> void ExplicitSolver<dim>::set_moduli() {
  PointState<dim>& point = state_.point;
  for (std::size_t p = 0; p < point.size(); ++p) {
    const plasticity::Material& material = body().material_of(p);
    point.shear_modulus[p] = material.shear_modulus();
    point.wave_modulus[p] = material.wave_modulus(model_.plane_stress);
  }
}

template ExplicitSolver<2>::ExplicitSolver(Problem<2>, Fields<2>, Field);
template ExplicitSolver<3>::ExplicitSolver(Problem<3>, Fields<3>, Field);
template Cloud<2> ExplicitSolver<2>::present_cloud() const;
template Cloud<3> ExplicitSolver<3>::present_cloud() const;
template void ExplicitSolver<2>::prepare();
template void ExplicitSolver<3>::prepare();
template void ExplicitSolver<2>::prepare(const Resampling<2>&);
template void ExplicitSolver<3>::prepare(const Resampling<3>&);
template void ExplicitSolver<2>::renew(Cloud<2>, const Resampling<2>*);
template void ExplicitSolver<3>::renew(Cloud<3>, const Resampling<3>*);
template void ExplicitSolver<2>::release();
template void ExplicitSolver<3>::release();
template void ExplicitSolver<2>::regain();
template void ExplicitSolver<3>::regain();
template std::vector<FieldTable*> ExplicitSolver<2>::node_tables();
template std::vector<FieldTable*> ExplicitSolver<3>::node_tables();
template std::vector<FieldTable*> ExplicitSolver<2>::point_tables();
template std::vector<FieldTable*> ExplicitSolver<3>::point_tables();
template void ExplicitSolver<2>::place_reference();
template void ExplicitSolver<3>::place_reference();
template double ExplicitSolver<2>::wanted_step() const;
template double ExplicitSolver<3>::wanted_step() const;
template void ExplicitSolver<2>::choose_mass_factors();
template void ExplicitSolver<3>::choose_mass_factors();
template void ExplicitSolver<2>::scale_masses();
template void ExplicitSolver<3>::scale_masses();
template void ExplicitSolver<2>::share_velocities();
template void ExplicitSolver<3>::share_velocities();
template void ExplicitSolver<2>::start_points();
template void ExplicitSolver<3>::start_points();
template void ExplicitSolver<2>::start_flow_stress(std::size_t);
template void ExplicitSolver<3>::start_flow_stress(std::size_t);
template void ExplicitSolver<2>::set_moduli();
template void ExplicitSolver<3>::set_moduli();

} // namespace cnem
