// What goes over to the nodes of a resampled cloud, and what that does to energy.
#include "mechanics/explicit_solver.hpp"
#include "plasticity/log_strain.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

/// What ln b_e has of volume change beside thermal expansion: pressure is −κ times it.
template<int dim>
double dilatation(const plasticity::Symmetric<dim>& log_elastic, const plasticity::Material& material,
                  double temperature) {
  return 0.5 * log_elastic.template head<3>().sum() -
         3.0 * material.expansion * (temperature - material.expansion_reference);
}

} // namespace

/// (1 − ω)⟨θ − opening⟩² of each point, θ the dilatation: the energy of its tension over κ/2. Expects b_e in
/// place of C_p⁻¹. Empty without damage.
template<int dim> Field ExplicitSolver<dim>::held_tension() {
  if (!damage_.active()) return {};
  const PointState<dim>& point = state_.point;
  Field held(point.size());
  for (std::size_t p = 0; p < held.size(); ++p) {
    const auto log_elastic = plasticity::logarithm<dim>(plasticity::at_point<dim>(point.elastic, p));
    const double tension =
        dilatation<dim>(log_elastic, material_of(p), point.temperature[p]) - damage_.opening()[p];
    held[p] = tension > 0.0 ? (1.0 - point.softening[p]) * tension * tension : 0.0;
  }
  return held;
}

/// ln b_e averaged over the parcels of a node, so that the mean is objective and its volume change additive,
/// drawn back to the yield surface of the averaged state without counting plastic work. Where broken matter
/// is mixed with sound matter its gap must not come to bear on the latter: as much of the dilatation becomes
/// an opening as leaves no more than the tension that the parts held.
template<int dim>
void ExplicitSolver<dim>::mix_elastic(const Resampling<dim>& change, const Field& mass,
                                      const Field& tension) {
  PointState<dim>& point = state_.point;
  Fields<symmetric_size<dim>> mixed;
  for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k].resize(change.parcels.size());
  for (std::size_t p = 0; p < change.parcels.size(); ++p) {
    const auto first = static_cast<std::size_t>(change.parcels.begin[p]),
               last = static_cast<std::size_t>(change.parcels.begin[p + 1]);
    auto elastic =
        plasticity::at_point<dim>(point.elastic, static_cast<std::size_t>(change.parcels.node[first]));
    if (last - first > 1) {
      elastic.setZero();
      double total = 0.0, volume = 0.0;
      for (std::size_t e = first; e < last; ++e) {
        const auto k = static_cast<std::size_t>(change.parcels.node[e]);
        const double share = change.parcels.weight[e] * mass[k];
        const auto part = plasticity::logarithm<dim>(plasticity::at_point<dim>(point.elastic, k));
        elastic += share * part;
        volume += share * std::exp(0.5 * part.template head<3>().sum());
        total += share;
      }
      elastic /= total;
      const plasticity::Material& material = material_of(p);
      const double softening = material.damage ? point.softening[p] : 0.0;
      if (softening > 0.0) // gaps are volumes, which add
        elastic.template head<3>().array() +=
            2.0 / 3.0 * (std::log(volume / total) - 0.5 * elastic.template head<3>().sum());
      if (softening > 0.0 && softening < 1.0) {
        double& opening = damage_.opening()[p];
        opening = std::max(opening, dilatation<dim>(elastic, material, point.temperature[p]) -
                                        std::sqrt(tension[p] / (1.0 - softening)));
      }
      const double strength =
          point.strength[p] * (material.damage ? material.damage->flow_share(softening) : 1.0);
      if (material.hardening)
        elastic = plasticity::limited_to<dim>(
            elastic,
            strength * material.hardening->flow_stress(point.plastic_strain[p], point.plastic_rate[p],
                                                       point.temperature[p]),
            material.elasticity.mu());
      elastic = plasticity::exponential<dim>(elastic);
    }
    for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k][p] = elastic[static_cast<Eigen::Index>(k)];
  }
  point.elastic = std::move(mixed);
}

/// Expects b_e in place of C_p⁻¹ (push_forward).
template<int dim> void ExplicitSolver<dim>::carry_over(const Resampling<dim>& change) {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  const NodeRows& parcels = change.parcels;
  const Field mass = node.mass;
  const Field capacity = model_.thermal ? node.heat_capacity : mass; // without heat there may be none

  const Field momentum_mass = inertia();
  Field tension = held_tension();
  if (!mass_scale_.empty()) carry_mean(parcels, mass, mass_scale_);
  exchange_.carry_over(parcels, mass);
  edge_defect_.carry_over(parcels, mass);
  carry_sum(parcels, node.mass);
  carry_sum(parcels, node.heat_capacity);
  for (Field& component : node.velocity) carry_mean(parcels, momentum_mass, component);
  for (Field* value : {&point.plastic_strain, &point.plastic_rate, &point.plastic_work, &point.dissipation,
                       &point.strength, &point.stress_free, &flow_stress_, &viscous_pressure_})
    carry_mean(parcels, mass, *value);
  if (damage_.active()) {
    for (Field* value :
         {&point.damage, &point.softening, &point.initiation_strain, &damage_.opening(), &tension})
      carry_mean(parcels, mass, *value);
    for (std::size_t p = 0; p < point.damage.size(); ++p)
      if (point.damage[p] < 1.0) point.initiation_strain[p] = 0.0; // a mixed point is yet to initiate
  }
  carry_mean(parcels, capacity, node.temperature);
  carry_mean(parcels, capacity, initial_temperature_);
  point.temperature = node.temperature;
  for (Field& component : initial_position_) carry_label(change.labels, component);
  carry_label(change.labels, point.material);
  if (!model_.node_material.empty()) carry_label(change.labels, model_.node_material);
  mix_elastic(change, mass, tension);

  const std::size_t n = change.cloud.position.size();
  for (std::size_t k = 0; k < dim; ++k) {
    node.position[k].resize(n);
    for (std::size_t i = 0; i < n; ++i)
      node.position[k][i] = change.cloud.position[i][static_cast<Eigen::Index>(k)];
  }
  resize_fields(n);
  if (local_.on()) local_.follow(change.labels);
  start_load_weight_.clear();
  model_.supports.resample(change);
  model_.loads.resample(change.cloud, initial_position_);
  model_.heat_boundaries.resample(change);
}

/// Fields that each step or reference makes anew.
template<int dim> void ExplicitSolver<dim>::resize_fields(std::size_t n) {
  PointState<dim>& point = state_.point;
  velocity_before_ = state_.node.velocity;
  resize_all(state_.node.force, n);
  resize_all(point.piola, n);
  resize_all(point.deformation, n);
  for (Field* value : {&point.equivalent_stress, &point.pressure, &point.stored_energy, &jacobian_,
                       &shear_modulus_, &wave_modulus_, &density_, &contact_heat_, &heat_flow_})
    value->assign(n, 0.0);
  heat_contacts_.clear();
  set_moduli();
}

/// All fields, before a checkpoint fills them. Expects the materials of the points.
template<int dim> void ExplicitSolver<dim>::resize_state(std::size_t n) {
  NodeState<dim>& node = state_.node;
  PointState<dim>& point = state_.point;
  for (Fields<dim>* fields : {&node.reference, &node.position, &node.velocity, &initial_position_})
    resize_all(*fields, n);
  resize_all(point.elastic, n);
  for (Field* value :
       {&node.mass, &node.heat_capacity, &node.temperature, &initial_temperature_, &point.plastic_strain,
        &point.plastic_rate, &point.plastic_work, &point.dissipation, &point.strength, &point.stress_free,
        &point.temperature, &flow_stress_, &viscous_pressure_})
    value->resize(n);
  if (damage_.active())
    for (Field* value : {&point.damage, &point.softening, &point.initiation_strain}) value->resize(n);
  exchange_.resize(n);
  if (!mass_scale_.empty()) mass_scale_.resize(n);
  resize_fields(n);
  edge_defect_.reset(shear_modulus_);
  edge_defect_.store_records(point.deformation, 0, n);
}

template void ExplicitSolver<2>::carry_over(const Resampling<2>&);
template void ExplicitSolver<2>::mix_elastic(const Resampling<2>&, const Field&, const Field&);
template Field ExplicitSolver<2>::held_tension();
template void ExplicitSolver<2>::resize_fields(std::size_t);
template void ExplicitSolver<2>::resize_state(std::size_t);

} // namespace cnem
