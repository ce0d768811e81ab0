#pragma once
// What heat makes of the temperatures of nodes: specific heat and conductivity may depend on them.
#include "mechanics/model.hpp"

namespace cnem {

template<int dim>
const HeatCurves& curves_of(const Model<dim>& model, const NodeState<dim>& node, std::size_t i) {
  return model.materials[index_of(node.material[i])].heat_curves;
}

/// Heat arrives at a node, J/m^(3−dim).
template<int dim> void warm(const Model<dim>& model, NodeState<dim>& node, std::size_t i, double heat) {
  node.temperature[i] =
      curves_of<dim>(model, node, i).warmed(node.temperature[i], heat / node.heat_capacity[i]);
}

/// The field whose gradient conducts, K: the potentials of all nodes, in `scratch` where they are not their
/// temperatures.
template<int dim> const Field& potential(const Model<dim>& model, const NodeState<dim>& node, Field& scratch);

/// Tied nodes get the one temperature with which none of their heat is lost.
template<int dim> void share_heat(const Model<dim>& model, const Ties<dim>& ties, NodeState<dim>& node);

/// While nodes are made of others their temperatures are enthalpies, so that means by heat capacity keep the
/// heat.
template<int dim> void to_enthalpy(const Model<dim>& model, NodeState<dim>& node);
template<int dim> void to_temperature(const Model<dim>& model, NodeState<dim>& node);

} // namespace cnem
