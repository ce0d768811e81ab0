#include "results/fields.hpp"

#include "core/error.hpp"
#include "core/fields/vector_at.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "mechanics/broken.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::results {

namespace {

template<int dim> FieldSource<dim> source_of(const Snapshot<dim>& shot) {
  return {shot.state, shot.adaptation};
}

template<int dim> Field own_values(const Snapshot<dim>& shot, const FieldInfo<dim>& e) {
  const FieldSource<dim> source = source_of(shot);
  Field values(e.at_nodes ? shot.state.node.size() : shot.state.point.size());
  for_each_block(values.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] = e.at(source, i);
  });
  return values;
}

} // namespace

template<int dim> FileArray array_in_files(const FieldInfo<dim>& info) {
  const std::string label = info.part.label.empty() ? info.shown.label : info.part.label;
  return {info.unit.empty() ? label : fmt::format("{} [{}]", label, info.unit), info.part.component};
}

template<int dim> Field values_at_points(const Snapshot<dim>& shot, const std::string& name) {
  const FieldInfo<dim>& e = field_info<dim>(name);
  const DiscreteOperators<dim>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  if (!e.at_nodes || op.nodal) return values;
  Field at_points(index_of(op.points));
  interpolate<dim>(op, values, at_points, 0, at_points.size());
  return at_points;
}

template<int dim> Field values_at_nodes(const Snapshot<dim>& shot, const std::string& name) {
  const FieldInfo<dim>& e = field_info<dim>(name);
  const DiscreteOperators<dim>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  return e.at_nodes ? values : average_at_nodes<dim>(op, values);
}

template<int dim> double largest_value(const Snapshot<dim>& shot, const std::string& name) {
  const FieldInfo<dim>& e = field_info<dim>(name);
  const std::size_t size = e.at_nodes ? shot.state.node.size() : shot.state.point.size();
  const FieldSource<dim> source = source_of(shot);
  double largest = e.at(source, 0);
  for (std::size_t i = 1; i < size; ++i) largest = std::max(largest, e.at(source, i));
  return largest;
}

template<int dim>
double weighted_value(const Snapshot<dim>& shot, const std::string& name, std::span<const NodeIndex> node,
                      std::span<const double> weight) {
  const FieldInfo<dim>& e = field_info<dim>(name);
  const DiscreteOperators<dim>& op = shot.approximation.mechanics;
  double sum = 0.0;
  if (e.at_nodes || op.nodal) {
    for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * e.at(source_of(shot), index_of(node[k]));
    return sum;
  }
  const Field values = own_values(shot, e);
  for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * average_at_node<dim>(op, values, node[k]);
  return sum;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{}[{}]", name, unit);
}

template<int dim> double enclosed_measure(const Snapshot<dim>& shot) {
  const auto position = [&](NodeIndex node) {
    return vector_at<dim>(shot.state.node.position, index_of(node));
  };
  return cnem::enclosed_measure(shot.cloud.facets, position, shot.approximation.mechanics.space());
}

template<int dim> double broken_measure(const Snapshot<dim>& shot) {
  const DiscreteOperators<dim>& op = shot.approximation.mechanics;
  const PointState<dim>& point = shot.state.point;
  double volume = 0.0;
  const Field lost = lost_share(point);
  for (std::size_t p = 0; p < lost.size(); ++p)
    if (lost[p] >= 1.0) volume += op.volume[p] * point.stress_free[p];
  return volume;
}

template FileArray array_in_files(const FieldInfo<2>&);
template FileArray array_in_files(const FieldInfo<3>&);
template Field values_at_points(const Snapshot<2>&, const std::string&);
template Field values_at_points(const Snapshot<3>&, const std::string&);
template Field values_at_nodes(const Snapshot<2>&, const std::string&);
template Field values_at_nodes(const Snapshot<3>&, const std::string&);
template double largest_value(const Snapshot<2>&, const std::string&);
template double largest_value(const Snapshot<3>&, const std::string&);
template double weighted_value(const Snapshot<2>&, const std::string&, std::span<const NodeIndex>,
                               std::span<const double>);
template double weighted_value(const Snapshot<3>&, const std::string&, std::span<const NodeIndex>,
                               std::span<const double>);
template double enclosed_measure(const Snapshot<2>&);
template double enclosed_measure(const Snapshot<3>&);
template double broken_measure(const Snapshot<2>&);
template double broken_measure(const Snapshot<3>&);

} // namespace cnem::results
