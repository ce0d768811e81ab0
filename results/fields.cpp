#include "results/fields.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::results {

namespace {

double displacement(const Snapshot& shot, std::size_t k, std::size_t i) {
  return shot.state.node.position[k][i] - shot.initial_position[k][i];
}

/// Cauchy stress σ = P Fᵀ/det F at a point; components i, j of the plane, or zz for i = j = 2.
double cauchy(const Snapshot& shot, std::size_t i, std::size_t j, std::size_t p) {
  const PointState<2>& point = shot.state.point;
  const double J = jacobian<2>(point.deformation, p);
  return i == 2 ? point.piola[4][p] * point.deformation[4][p] / J
                : (point.piola[2 * i][p] * point.deformation[2 * j][p] +
                   point.piola[2 * i + 1][p] * point.deformation[2 * j + 1][p]) /
                      J;
}

/// Volume ratio J of the present to the stress-free configuration.
double volume_ratio(const Snapshot& shot, std::size_t p) {
  const PointState<2>& point = shot.state.point;
  return jacobian<2>(point.deformation, p) / point.stress_free[p];
}

/// Zero where no material has a damage law.
double of_damage(const Field& values, std::size_t p) { return values.empty() ? 0.0 : values[p]; }

struct Entry {
  FieldInfo info;
  double (*at)(const Snapshot&, std::size_t); ///< value at a stress point or node
};

const std::vector<Entry>& entries() {
  using Shot = const Snapshot&;
  using Index = std::size_t;
  static const std::vector<Entry> list{
      {{"plastic_strain", "equivalent plastic strain", "", "", 1.0, ColourMap::strain, false},
       [](Shot s, Index p) { return s.state.point.plastic_strain[p]; }},
      {{"plastic_rate", "equivalent plastic strain rate", "1/s", "1/s", 1.0, ColourMap::heat, false},
       [](Shot s, Index p) { return s.state.point.plastic_rate[p]; }},
      {{"temperature", "temperature", "K", "K", 1.0, ColourMap::heat, true},
       [](Shot s, Index i) { return s.state.node.temperature[i]; }},
      {{"equivalent_stress", "von Mises stress", "Pa", "MPa", 1e6, ColourMap::heat, false},
       [](Shot s, Index p) { return s.state.point.equivalent_stress[p] / volume_ratio(s, p); }},
      {{"pressure", "pressure", "Pa", "MPa", 1e6, ColourMap::diverging, false},
       [](Shot s, Index p) { return s.state.point.pressure[p] / volume_ratio(s, p); }},
      {{"stress_xx", "stress xx", "Pa", "MPa", 1e6, ColourMap::diverging, false},
       [](Shot s, Index p) { return cauchy(s, 0, 0, p); }},
      {{"stress_yy", "stress yy", "Pa", "MPa", 1e6, ColourMap::diverging, false},
       [](Shot s, Index p) { return cauchy(s, 1, 1, p); }},
      {{"stress_zz", "stress zz", "Pa", "MPa", 1e6, ColourMap::diverging, false},
       [](Shot s, Index p) { return cauchy(s, 2, 2, p); }},
      {{"stress_xy", "stress xy", "Pa", "MPa", 1e6, ColourMap::diverging, false},
       [](Shot s, Index p) { return cauchy(s, 0, 1, p); }},
      {{"volume_ratio", "volume ratio J", "", "", 1.0, ColourMap::strain, false}, volume_ratio},
      {{"damage", "damage D", "", "", 1.0, ColourMap::strain, false, false, true},
       [](Shot s, Index p) { return of_damage(s.state.point.damage, p); }},
      {{"softening", "softening", "", "", 1.0, ColourMap::strain, false, false, true},
       [](Shot s, Index p) { return of_damage(s.state.point.softening, p); }},
      {{"initiation_strain", "plastic strain at initiation", "", "", 1.0, ColourMap::strain, false, false,
        true},
       [](Shot s, Index p) { return of_damage(s.state.point.initiation_strain, p); }},
      {{"velocity_x", "velocity x", "m/s", "m/s", 1.0, ColourMap::diverging, true},
       [](Shot s, Index i) { return s.state.node.velocity[0][i]; }},
      {{"velocity_y", "velocity y", "m/s", "m/s", 1.0, ColourMap::diverging, true},
       [](Shot s, Index i) { return s.state.node.velocity[1][i]; }},
      {{"displacement_x", "displacement x", "m", "mm", 1e-3, ColourMap::diverging, true},
       [](Shot s, Index i) { return displacement(s, 0, i); }},
      {{"displacement_y", "displacement y", "m", "mm", 1e-3, ColourMap::diverging, true},
       [](Shot s, Index i) { return displacement(s, 1, i); }},
      {{"level", "level of refinement", "", "", 1.0, ColourMap::strain, true, true},
       [](Shot s, Index i) { return s.adaptation->level[i]; }},
      {{"indicator", "error indicator", "", "", 1.0, ColourMap::heat, true, true},
       [](Shot s, Index i) { return s.adaptation->indicator[i]; }},
      {{"age", "age of the node", "s", "µs", 1e-6, ColourMap::heat, true, true},
       [](Shot s, Index i) { return s.adaptation->age[i]; }},
  };
  return list;
}

const Entry& entry(const std::string& name) {
  for (const Entry& e : entries())
    if (e.info.name == name) return e;
  throw InputError(fmt::format("there is no field '{}'", name));
}

Field own_values(const Snapshot& shot, const Entry& e) {
  Field values(e.info.at_nodes ? shot.state.node.size() : shot.state.point.size());
  for_each_block(values.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] = e.at(shot, i);
  });
  return values;
}

} // namespace

const std::vector<FieldInfo>& field_catalogue() {
  static const std::vector<FieldInfo> list = [] {
    std::vector<FieldInfo> infos;
    for (const Entry& e : entries()) infos.push_back(e.info);
    return infos;
  }();
  return list;
}

const FieldInfo& field_info(const std::string& name) { return entry(name).info; }

Field values_at_points(const Snapshot& shot, const std::string& name) {
  const Entry& e = entry(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  if (!e.info.at_nodes || op.nodal) return values;
  Field at_points(static_cast<std::size_t>(op.points));
  interpolate<2>(op, values, at_points, 0, at_points.size());
  return at_points;
}

Field values_at_nodes(const Snapshot& shot, const std::string& name) {
  const Entry& e = entry(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  Field values = own_values(shot, e);
  return e.info.at_nodes ? values : average_at_nodes<2>(op, values);
}

double largest_value(const Snapshot& shot, const std::string& name) {
  const Entry& e = entry(name);
  const std::size_t size = e.info.at_nodes ? shot.state.node.size() : shot.state.point.size();
  double largest = e.at(shot, 0);
  for (std::size_t i = 1; i < size; ++i) largest = std::max(largest, e.at(shot, i));
  return largest;
}

double weighted_value(const Snapshot& shot, const std::string& name, std::span<const std::int32_t> node,
                      std::span<const double> weight) {
  const Entry& e = entry(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  double sum = 0.0;
  if (e.info.at_nodes || op.nodal) {
    for (std::size_t k = 0; k < node.size(); ++k)
      sum += weight[k] * e.at(shot, static_cast<std::size_t>(node[k]));
    return sum;
  }
  const Field values = own_values(shot, e);
  for (std::size_t k = 0; k < node.size(); ++k)
    sum += weight[k] * average_at_node<2>(op, values, static_cast<std::size_t>(node[k]));
  return sum;
}

double boundary_area(const Snapshot& shot) {
  const Fields<2>& x = shot.state.node.position;
  return enclosed_area(shot.cloud.facets, [&](std::int32_t node) {
    const auto i = static_cast<std::size_t>(node);
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
