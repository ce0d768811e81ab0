// What a checkpoint keeps of the solver. Operators are not kept: they follow from the reference positions.
#include "core/archive.hpp"
#include "core/error.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>

namespace cnem {

namespace {

template<int dim> void archive_state(Archive& archive, State<dim>& state) {
  NodeState<dim>& node = state.node;
  archive.number("solver/time", "s", state.time);
  archive.number("solver/step_before", "s", state.step_before);
  archive.integer("solver/step", state.step);
  archive.field("solver/node/reference", "m", node.reference);
  archive.field("solver/node/position", "m", node.position);
  archive.field("solver/node/velocity", "m/s", node.velocity);
  archive.field("solver/node/force", "N/m", node.force);
  archive.field("solver/node/mass", "kg/m", node.mass);
  archive.field("solver/node/temperature", "K", node.temperature);
  archive.field("solver/node/heat_capacity", "J/(K m)", node.heat_capacity);
  PointState<dim>& point = state.point;
  archive.field("solver/point/deformation", "1", point.deformation);
  archive.field("solver/point/elastic", "1", point.elastic);
  archive.field("solver/point/piola", "Pa", point.piola);
  archive.field("solver/point/plastic_strain", "1", point.plastic_strain);
  archive.field("solver/point/plastic_rate", "1/s", point.plastic_rate);
  archive.field("solver/point/equivalent_stress", "Pa", point.equivalent_stress);
  archive.field("solver/point/pressure", "Pa", point.pressure);
  archive.field("solver/point/stored_energy", "J/m^3", point.stored_energy);
  archive.field("solver/point/plastic_work", "J/m^3", point.plastic_work);
  archive.field("solver/point/dissipation", "J/m^3", point.dissipation);
  archive.field("solver/point/stress_free", "1", point.stress_free);
  archive.field("solver/point/temperature", "K", point.temperature);
  if (point.damage.empty()) return;
  archive.field("solver/point/damage", "1", point.damage);
  archive.field("solver/point/softening", "1", point.softening);
  archive.field("solver/point/initiation_strain", "1", point.initiation_strain);
}

void archive_ledger(Archive& archive, EnergyLedger& ledger) {
  archive.number("solver/energy/stabilisation", "J/m", ledger.stabilisation);
  archive.number("solver/energy/damage", "J/m", ledger.damage);
  archive.number("solver/energy/viscosity", "J/m", ledger.viscosity);
  archive.number("solver/energy/friction", "J/m", ledger.friction);
  archive.number("solver/energy/impact", "J/m", ledger.impact);
  archive.number("solver/energy/penalty_release", "J/m", ledger.penalty_release);
  archive.number("solver/energy/rereference", "J/m", ledger.rereference);
  archive.number("solver/energy/resampling", "J/m", ledger.resampling);
  archive.number("solver/energy/tools", "J/m", ledger.tools);
  archive.number("solver/energy/pressure_exchange", "J/m", ledger.pressure_exchange);
  archive.number("solver/energy/supports", "J/m", ledger.supports);
  archive.number("solver/energy/recovery", "J/m", ledger.recovery);
  archive.number("solver/energy/loads", "J/m", ledger.loads);
  archive.number("solver/energy/heat_generated", "J/m", ledger.heat_generated);
  archive.number("solver/energy/heat_exchanged", "J/m", ledger.heat_exchanged);
  archive.number("solver/energy/initial", "J/m", ledger.initial);
}

} // namespace

/// The nodes themselves, once resampling has made them other than those of the case.
template<int dim> void ExplicitSolver<dim>::archive_cloud(Archive& archive) {
  archive.integer("solver/resamplings", resamplings_);
  if (resamplings_ == 0) {
    Fields<dim> initial = initial_position_;
    archive.field("solver/node/initial_position", "m", initial);
    if (initial != initial_position_)
      throw IoError("its nodes are not those that this version makes of the case");
    return;
  }
  PointState<dim>& point = state_.point;
  std::vector<std::int32_t> facets;
  for (const Facet<dim>& facet : model_.cloud.facets) {
    facets.insert(facets.end(), facet.node.begin(), facet.node.end());
    facets.push_back(facet.piece);
  }
  archive.integers("solver/cloud/facets", facets);
  archive.integers("solver/point/material", point.material);
  const std::size_t n = point.material.size();
  if (archive.loading()) {
    model_.cloud.position.resize(n);
    model_.cloud.facets.clear();
    for (std::size_t at = 0; at + dim < facets.size(); at += dim + 1) {
      Facet<dim> facet;
      std::copy_n(facets.begin() + static_cast<std::ptrdiff_t>(at), dim, facet.node.begin());
      facet.piece = facets[at + dim];
      model_.cloud.facets.push_back(facet);
    }
    if (!model_.node_material.empty()) model_.node_material = point.material;
    resize_state(n);
  }
  archive.field("solver/node/initial_position", "m", initial_position_);
  archive.field("solver/node/initial_temperature", "K", initial_temperature_);
  archive.field("solver/point/strength", "1", point.strength);
  model_.supports.archive_nodes(archive, n);
  model_.heat_boundaries.archive_nodes(archive);
  if (!archive.loading()) return;
  model_.loads.resample(model_.cloud, initial_position_);
  model_.heat_boundaries.resample(model_.cloud);
}

template<int dim> void ExplicitSolver<dim>::archive(Archive& archive) {
  archive_cloud(archive);
  archive_state(archive, state_);
  archive.field("solver/point/flow_stress", "Pa", flow_stress_);
  archive.field("solver/point/density", "kg/m^3", density_);
  archive.field("solver/point/jacobian", "1", jacobian_);
  archive.field("solver/point/viscous_pressure", "Pa", viscous_pressure_);
  archive_ledger(archive, running_);
  archive.number("solver/energy/plastic_offset", "J/m", plastic_offset_);
  archive.number("solver/energy/tie_loss", "J/m", tie_loss_);
  archive.number("solver/viscosity_ratio", "1", viscosity_ratio_);
  archive.number("solver/conduction_step", "s", conduction_step_);
  archive.integer("solver/references", references_);
  edge_defect_.archive(archive);
  damage_.archive(archive, state_.point.size());
  if (damage_.active()) archive.field("solver/point/wave_modulus", "Pa", wave_modulus_);
  archive.number("solver/finest_before", "s", finest_before_);
  if (local_.on()) {
    local_.archive(archive);
    archive.integer("solver/local/on_new_reference", on_new_reference_);
    std::vector<double> next(next_levels_.begin(), next_levels_.end());
    archive.list("solver/local/next_level", "1", next);
    next_levels_.clear();
    for (const double level : next) next_levels_.push_back(static_cast<std::int8_t>(level));
  }
  exchange_.archive(archive);
  if (model_.mass_scaling.active()) archive.field("solver/node/mass_scale", "1", mass_scale_);
  model_.supports.archive(archive);
  if (archive.loading()) // pairs of touching bodies are listed on it
    model_.contact.set_boundary(model_.cloud.facets, state_.node.size(), model_.supports.constraints(),
                                model_.ties.group());
  model_.contact.archive(archive);
  if (!archive.loading()) return;

  NodeState<dim>& node = state_.node;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (std::size_t k = 0; k < dim; ++k)
      model_.cloud.position[i][static_cast<Eigen::Index>(k)] = node.reference[k][i];
  approximation_ = model_.method->rebuild(model_.cloud);
  if (model_.thermal) set_conduction();
  place_reference();
  set_levels(local_.level());
  scale_masses();
  reset_exchange();
  model_.loads.evaluate(state_.time, node.position, node.mass);
}

template void ExplicitSolver<2>::archive_cloud(Archive&);
template void ExplicitSolver<2>::archive(Archive&);

} // namespace cnem
