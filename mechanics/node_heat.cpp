#include "mechanics/node_heat.hpp"

#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

template<int dim> bool any_curves(const Model<dim>& model) {
  return std::any_of(model.materials.begin(), model.materials.end(),
                     [](const plasticity::Material& material) { return material.heat_curves.given(); });
}

/// The temperature between the coldest and the warmest of a group that keeps its heat: Newton's method, and
/// halves where it leaves the bracket.
template<int dim>
double common_temperature(const Model<dim>& model, const NodeState<dim>& node,
                          std::span<const NodeIndex> group) {
  double low = infinite, high = -infinite, heat = 0.0, capacity = 0.0, temperature = 0.0;
  for (const NodeIndex member : group) {
    const auto i = index_of(member);
    low = std::min(low, node.temperature[i]);
    high = std::max(high, node.temperature[i]);
    heat += node.heat_capacity[i] * curves_of<dim>(model, node, i).enthalpy(node.temperature[i]);
    capacity += node.heat_capacity[i];
    temperature += node.heat_capacity[i] * node.temperature[i];
  }
  temperature /= capacity;
  constexpr int most = 100;
  for (int k = 0; k < most && low < high; ++k) {
    double lacking = heat, slope = 0.0;
    for (const NodeIndex member : group) {
      const auto i = index_of(member);
      const HeatCurves& curves = curves_of<dim>(model, node, i);
      lacking -= node.heat_capacity[i] * curves.enthalpy(temperature);
      slope += node.heat_capacity[i] * curves.specific_heat_factor(temperature);
    }
    (lacking > 0.0 ? low : high) = temperature;
    const double next = temperature + lacking / slope;
    if (std::abs(next - temperature) <= 1e-15 * temperature) break;
    temperature = next > low && next < high ? next : 0.5 * (low + high);
  }
  return temperature;
}

} // namespace

template<int dim>
const Field& potential(const Model<dim>& model, const NodeState<dim>& node, Field& scratch) {
  if (!any_curves(model)) return node.temperature;
  scratch.resize(node.size());
  for (std::size_t i = 0; i < scratch.size(); ++i)
    scratch[i] = curves_of<dim>(model, node, i).potential(node.temperature[i]);
  return scratch;
}

template<int dim> void share_heat(const Model<dim>& model, const Ties<dim>& ties, NodeState<dim>& node) {
  if (ties.empty()) return;
  if (!model.thermal) return ties.share(node.mass, node.temperature); // there may be no capacity
  if (!any_curves(model)) return ties.share(node.heat_capacity, node.temperature);
  ties.each_group([&](std::span<const NodeIndex> group) {
    const double common = common_temperature(model, node, group);
    for (const NodeIndex i : group) node.temperature[index_of(i)] = common;
  });
}

template<int dim> void to_enthalpy(const Model<dim>& model, NodeState<dim>& node) {
  if (!any_curves(model)) return;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (Field* temperature : std::initializer_list<Field*>{&node.temperature, &node.initial_temperature})
      (*temperature)[i] = curves_of<dim>(model, node, i).enthalpy((*temperature)[i]);
}

template<int dim> void to_temperature(const Model<dim>& model, NodeState<dim>& node) {
  if (!any_curves(model)) return;
  for (std::size_t i = 0; i < node.size(); ++i)
    for (Field* temperature : std::initializer_list<Field*>{&node.temperature, &node.initial_temperature})
      (*temperature)[i] = curves_of<dim>(model, node, i).temperature_of((*temperature)[i]);
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template const Field& potential<dim>(const Model<dim>&, const NodeState<dim>&, Field&);                    \
  template void share_heat<dim>(const Model<dim>&, const Ties<dim>&, NodeState<dim>&);                       \
  template void to_enthalpy<dim>(const Model<dim>&, NodeState<dim>&);                                        \
  template void to_temperature<dim>(const Model<dim>&, NodeState<dim>&);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem
