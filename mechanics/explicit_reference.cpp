// A solver's start and its references: cells, functions and everything that belongs to them.
#include "core/error.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"
#include "plasticity/return_map.hpp"

#include <limits>

namespace cnem {

namespace {

template<int dim> void set_identity(Fields<tensor_size<dim>>& f, std::size_t size) {
  resize_all(f, size, 0.0);
  if constexpr (dim == 2)
    for (const std::size_t k : {0U, 3U, 4U}) f[k].assign(size, 1.0);
  else
    for (const std::size_t k : {0U, 4U, 8U}) f[k].assign(size, 1.0);
}

} // namespace

template<int dim>
ExplicitSolver<dim>::ExplicitSolver(Model<dim> model, Fields<dim> velocity, Field temperature)
    : model_(std::move(model)), edge_defect_(model_.stabilisation), damage_(model_.materials),
      exchange_(model_.pressure_exchange), local_(model_.local) {
  NodeState<dim>& node = state_.node;
  const auto n = static_cast<std::size_t>(model_.cloud.nodes());
  resize_all(node.position, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < dim; ++k)
      node.position[k][i] = model_.cloud.position[i][static_cast<Eigen::Index>(k)];
  initial_position_ = node.position;
  node.velocity = std::move(velocity);
  velocity_before_ = node.velocity;
  initial_temperature_ = std::move(temperature);
  node.temperature = initial_temperature_;
  contact_heat_.assign(n, 0.0);
  heat_flow_.assign(n, 0.0);
  resize_all(node.force, n);
  prepare();
  if (!model_.ties.empty())
    for (Field& component : node.velocity) model_.ties.share(inertia(), component);
  running_.initial = ledger().total();
}

template<int dim> Cloud<dim> ExplicitSolver<dim>::present_cloud() const {
  Cloud<dim> cloud = model_.cloud;
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
  const bool start = references_ == 0;
  if (!start)
    require(model_.method->promises(), Promise::one_point_per_node, model_.method->name(), "a new reference");
  Approximation<dim> rebuilt = model_.method->rebuild(cloud);

  double elastic_before = 0.0, plastic_before = 0.0;
  if (!start) {
    elastic_before = energy_over_body(point.stored_energy);
    plastic_before = energy_over_body(point.plastic_work);
    running_.penalty_release += running_.stabilisation;
    push_forward(point);
  }
  const double kinetic_before = change ? kinetic_energy() : 0.0;
  if (change) carry_over(*change);
  model_.cloud = std::move(cloud);
  approximation_ = std::move(rebuilt);
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const auto points = static_cast<std::size_t>(op.points);
  node.reference = node.position;
  if (start) start_points();
  place_reference();
  scale_masses();
  set_identity<dim>(point.deformation, points);
  jacobian_.assign(points, 1.0);
  damage_.weaken(point);
  const std::ptrdiff_t bad = plasticity::update_stress(model_.materials, point.material, points_to_stress(),
                                                       0, static_cast<std::ptrdiff_t>(points), 0.0);
  if (bad >= 0) diverged(static_cast<std::size_t>(bad), "elastic strain");
  damage_.measure(op, model_.materials, point);
  if (damage_.active()) damage_.update(op, model_.materials, point, 0, points, 0.0);
  for (std::size_t p = 0; p < points; ++p) density_[p] = material_of(p).density * point.stress_free[p];

  edge_defect_.reset(shear_modulus_);
  if (edge_defect_.active(approximation_.links)) edge_defect_.store_records(point.deformation, 0, points);
  model_.contact.set_boundary(model_.cloud.facets, node.size(), model_.supports.constraints(),
                              model_.ties.group());
  reset_exchange();
  if (model_.thermal) set_conduction();
  conduction_step_ = 0.0;
  if (!start) {
    running_.rereference += elastic_before - energy_over_body(point.stored_energy);
    plastic_offset_ += plastic_before - energy_over_body(point.plastic_work);
  }
  copy_stress_columns<dim>(point.piola, stress_);
  running_.stabilisation = 0.0;
  rebuild_levels();
  ++references_;
  if (!change) return;
  running_.resampling += kinetic_before - kinetic_energy();
  ++resamplings_;
}

template<int dim> void ExplicitSolver<dim>::set_conduction() {
  const DiscreteOperators<dim>& op = approximation_.conduction;
  Field conductivity(static_cast<std::size_t>(op.points));
  for (std::size_t p = 0; p < conductivity.size(); ++p)
    conductivity[p] = material_of_node(op.first_node(p)).conductivity;
  conduction_.set_operators(op, std::move(conductivity));
}

template<int dim> void ExplicitSolver<dim>::reset_exchange() {
  if (!exchange_.active(approximation_.links)) return;
  Field bulk_modulus(state_.point.size());
  for (std::size_t p = 0; p < bulk_modulus.size(); ++p) bulk_modulus[p] = material_of(p).elasticity.kappa();
  exchange_.reset(model_.cloud.facets, std::move(bulk_modulus));
}

/// What gathering passes read, on a new reference.
template<int dim> void ExplicitSolver<dim>::place_reference() {
  reference_ = side_by_side<dim>(state_.node.reference);
  position_ = side_by_side<dim>(state_.node.position);
  copy_stress_columns<dim>(state_.point.piola, stress_);
}

/// Inertia on a new reference; factors that depend on cells are those of the start.
template<int dim> void ExplicitSolver<dim>::scale_masses() {
  const MassScaling& scaling = model_.mass_scaling;
  if (!scaling.active()) return;
  const Field& mass = state_.node.mass;
  if (scaling.step <= 0.0) {
    mass_scale_.assign(mass.size(), scaling.factor);
  } else if (references_ == 0) {
    const double omega = 2.0 * model_.safety / scaling.step;
    const double alpha = edge_defect_.active(approximation_.links) ? model_.stabilisation : 0.0;
    mass_scale_ =
        scales_for_frequency(approximation_.mechanics, wave_modulus_, mass, omega * omega / (1.0 + alpha));
  }
  inertia_.resize(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i) inertia_[i] = mass_scale_[i] * mass[i];
}

/// Masses, and stress points at rest.
template<int dim> void ExplicitSolver<dim>::start_points() {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const auto points = static_cast<std::size_t>(op.points);
  const Field volume = op.node_volume();
  node.mass.resize(volume.size());
  node.heat_capacity.resize(volume.size());
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const plasticity::Material& material = material_of_node(i);
    node.mass[i] = material.density * volume[i];
    node.heat_capacity[i] = node.mass[i] * material.specific_heat;
  }
  resize_all(point.elastic, points, 0.0);
  for (std::size_t k = 0; k < 3; ++k) point.elastic[k].assign(points, 1.0);
  resize_all(point.piola, points);
  for (Field* field : {&point.plastic_strain, &point.plastic_rate, &point.equivalent_stress, &point.pressure,
                       &point.stored_energy, &point.plastic_work, &point.dissipation, &point.temperature,
                       &viscous_pressure_, &jacobian_, &shear_modulus_, &wave_modulus_, &density_})
    field->assign(points, 0.0);
  point.stress_free.assign(points, 1.0);
  point.strength.assign(points, 1.0);
  point.material.assign(points, 0);
  damage_.start(point);
  flow_stress_.assign(points, std::numeric_limits<double>::infinity());
  interpolate<dim>(op, node.temperature, point.temperature, 0, points);
  if (!model_.strength.empty()) interpolate<dim>(op, model_.strength, point.strength, 0, points);
  if (!model_.node_material.empty())
    for (std::size_t p = 0; p < points; ++p) point.material[p] = model_.node_material[op.first_node(p)];
  set_moduli();
  for (std::size_t p = 0; p < points; ++p)
    if (const auto& hardening = material_of(p).hardening)
      flow_stress_[p] =
          point.strength[p] * hardening->flow_stress(0.0, hardening->rate0, point.temperature[p]);
}

template<int dim> void ExplicitSolver<dim>::set_moduli() {
  for (std::size_t p = 0; p < shear_modulus_.size(); ++p) {
    const plasticity::Elasticity& elasticity = material_of(p).elasticity;
    shear_modulus_[p] = elasticity.mu();
    wave_modulus_[p] = elasticity.lambda() + 2.0 * elasticity.mu();
  }
}

template ExplicitSolver<2>::ExplicitSolver(Model<2>, Fields<2>, Field);
template Cloud<2> ExplicitSolver<2>::present_cloud() const;
template void ExplicitSolver<2>::prepare();
template void ExplicitSolver<2>::prepare(const Resampling<2>&);
template void ExplicitSolver<2>::renew(Cloud<2>, const Resampling<2>*);
template void ExplicitSolver<2>::set_conduction();
template void ExplicitSolver<2>::reset_exchange();
template void ExplicitSolver<2>::place_reference();
template void ExplicitSolver<2>::scale_masses();
template void ExplicitSolver<2>::start_points();
template void ExplicitSolver<2>::set_moduli();

} // namespace cnem
