#include "results/fields.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::results {

namespace {

FieldSource source_of(const Snapshot& shot) { return {shot.state, shot.adaptation}; }

Field own_values(const Snapshot& shot, const FieldInfo& e) {
  const FieldSource source = source_of(shot);
  Field values(e.at_nodes ? shot.state.node.size() : shot.state.point.size());
  for_each_block(values.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] = e.at(source, i);
  });
  return values;
}

} // namespace

Field values_at_points(const Snapshot& shot, const std::string& name) {
  const FieldInfo& e = field_info(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  if (!e.at_nodes || op.nodal) return values;
  Field at_points(index_of(op.points));
  interpolate<2>(op, values, at_points, 0, at_points.size());
  return at_points;
}

Field values_at_nodes(const Snapshot& shot, const std::string& name) {
  const FieldInfo& e = field_info(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  return e.at_nodes ? values : average_at_nodes<2>(op, values);
}

double largest_value(const Snapshot& shot, const std::string& name) {
  const FieldInfo& e = field_info(name);
  const std::size_t size = e.at_nodes ? shot.state.node.size() : shot.state.point.size();
  const FieldSource source = source_of(shot);
  double largest = e.at(source, 0);
  for (std::size_t i = 1; i < size; ++i) largest = std::max(largest, e.at(source, i));
  return largest;
}

double weighted_value(const Snapshot& shot, const std::string& name, std::span<const std::int32_t> node,
                      std::span<const double> weight) {
  const FieldInfo& e = field_info(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  double sum = 0.0;
  if (e.at_nodes || op.nodal) {
    for (std::size_t k = 0; k < node.size(); ++k) sum += weight[k] * e.at(source_of(shot), index_of(node[k]));
    return sum;
  }
  const Field values = own_values(shot, e);
  for (std::size_t k = 0; k < node.size(); ++k)
    sum += weight[k] * average_at_node<2>(op, values, index_of(node[k]));
  return sum;
}

double boundary_area(const Snapshot& shot) {
  const Fields<2>& x = shot.state.node.position;
  return enclosed_area(shot.cloud.facets, [&](std::int32_t node) {
    const auto i = index_of(node);
    return Vec2{x[0][i], x[1][i]};
  });
}

double broken_area(const Snapshot& shot) {
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  const PointState<2>& point = shot.state.point;
  double area = 0.0;
  for (std::size_t p = 0; p < point.softening.size(); ++p)
    if (point.softening[p] >= 1.0)
      area += op.volume[p] * point.stress_free[p] /
              (op.of_revolution() ? 2.0 * std::numbers::pi * op.radius[p] : 1.0);
  return area;
}

} // namespace cnem::results
