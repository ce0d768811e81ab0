#pragma once
// The terms of a step, in the order in which they act and stand in the ledger.
#include "mechanics/terms/term.hpp"

#include <memory>
#include <vector>

namespace cnem {

/// All terms of a model: a new one is a file of its own and a line in list.cpp.
template<int dim> std::vector<std::unique_ptr<Term<dim>>> make_terms(const Model<dim>& model);

// What makes them, each in the file of its name; null where the model has no use for it.
template<int dim> std::unique_ptr<Term<dim>> body_energy(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> equation_of_state(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> point_damage(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> thermal_expansion(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> bulk_viscosity(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> plane_stress(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> plies(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> contact_and_supports(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> cohesive(const Model<dim>& model);
template<> std::unique_ptr<Term<2>> cohesive(const Model<2>& model);
template<> std::unique_ptr<Term<3>> cohesive(const Model<3>& model);
template<int dim> std::unique_ptr<Term<dim>> edge_defect(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> reference_energy(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> pressure_exchange(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> stress_annealing(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> matter_flow(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> applied_loads(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> heat(const Model<dim>& model);
template<int dim> std::unique_ptr<Term<dim>> tool_heat(const Model<dim>& model);
template<> std::unique_ptr<Term<2>> tool_heat(const Model<2>& model);
template<> std::unique_ptr<Term<3>> tool_heat(const Model<3>& model);

} // namespace cnem
