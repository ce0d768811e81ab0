#include "app/fields.hpp"

#include "core/error.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

namespace {

Field displacement(const Snapshot& shot, std::size_t k) {
  Field u = shot.state.node.position[k];
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= shot.initial_position[k][i];
  return u;
}

/// Cauchy stress σ = P Fᵀ/det F; components i, j of the plane, or zz for i = j = 2.
Field cauchy(const Snapshot& shot, std::size_t i, std::size_t j) {
  const PointState<2>& point = shot.state.point;
  Field sigma(point.size());
  for (std::size_t p = 0; p < sigma.size(); ++p) {
    const double J = jacobian<2>(point.deformation, p);
    sigma[p] = i == 2 ? point.piola[4][p] * point.deformation[4][p] / J
                      : (point.piola[2 * i][p] * point.deformation[2 * j][p] +
                         point.piola[2 * i + 1][p] * point.deformation[2 * j + 1][p]) /
                            J;
  }
  return sigma;
}

/// Volume ratio J of the present to the stress-free configuration.
Field volume_ratio(const Snapshot& shot) {
  const PointState<2>& point = shot.state.point;
  Field J(point.size());
  for (std::size_t p = 0; p < J.size(); ++p) J[p] = jacobian<2>(point.deformation, p) / point.stress_free[p];
  return J;
}

Field divided(Field a, const Field& b) {
  for (std::size_t p = 0; p < a.size(); ++p) a[p] /= b[p];
  return a;
}

/// Zeros where no material has a damage law.
Field of_damage(const Snapshot& shot, const Field& values) {
  return values.empty() ? Field(shot.state.point.size(), 0.0) : values;
}

struct Entry {
  FieldInfo info;
  Field (*values)(const Snapshot&);
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list{
      {{"plastic_strain", "equivalent plastic strain", "", "", 1.0, io::ColourMap::strain, false},
       [](const Snapshot& s) { return s.state.point.plastic_strain; }},
      {{"plastic_rate", "equivalent plastic strain rate", "1/s", "1/s", 1.0, io::ColourMap::heat, false},
       [](const Snapshot& s) { return s.state.point.plastic_rate; }},
      {{"temperature", "temperature", "K", "K", 1.0, io::ColourMap::heat, true},
       [](const Snapshot& s) { return s.state.node.temperature; }},
      {{"equivalent_stress", "von Mises stress", "Pa", "MPa", 1e6, io::ColourMap::heat, false},
       [](const Snapshot& s) { return divided(s.state.point.equivalent_stress, volume_ratio(s)); }},
      {{"pressure", "pressure", "Pa", "MPa", 1e6, io::ColourMap::diverging, false},
       [](const Snapshot& s) { return divided(s.state.point.pressure, volume_ratio(s)); }},
      {{"stress_xx", "stress xx", "Pa", "MPa", 1e6, io::ColourMap::diverging, false},
       [](const Snapshot& s) { return cauchy(s, 0, 0); }},
      {{"stress_yy", "stress yy", "Pa", "MPa", 1e6, io::ColourMap::diverging, false},
       [](const Snapshot& s) { return cauchy(s, 1, 1); }},
      {{"stress_zz", "stress zz", "Pa", "MPa", 1e6, io::ColourMap::diverging, false},
       [](const Snapshot& s) { return cauchy(s, 2, 2); }},
      {{"stress_xy", "stress xy", "Pa", "MPa", 1e6, io::ColourMap::diverging, false},
       [](const Snapshot& s) { return cauchy(s, 0, 1); }},
      {{"volume_ratio", "volume ratio J", "", "", 1.0, io::ColourMap::strain, false}, volume_ratio},
      {{"damage", "damage D", "", "", 1.0, io::ColourMap::strain, false, true},
       [](const Snapshot& s) { return of_damage(s, s.state.point.damage); }},
      {{"softening", "softening", "", "", 1.0, io::ColourMap::strain, false, true},
       [](const Snapshot& s) { return of_damage(s, s.state.point.softening); }},
      {{"initiation_strain", "plastic strain at initiation", "", "", 1.0, io::ColourMap::strain, false, true},
       [](const Snapshot& s) { return of_damage(s, s.state.point.initiation_strain); }},
      {{"velocity_x", "velocity x", "m/s", "m/s", 1.0, io::ColourMap::diverging, true},
       [](const Snapshot& s) { return s.state.node.velocity[0]; }},
      {{"velocity_y", "velocity y", "m/s", "m/s", 1.0, io::ColourMap::diverging, true},
       [](const Snapshot& s) { return s.state.node.velocity[1]; }},
      {{"displacement_x", "displacement x", "m", "mm", 1e-3, io::ColourMap::diverging, true},
       [](const Snapshot& s) { return displacement(s, 0); }},
      {{"displacement_y", "displacement y", "m", "mm", 1e-3, io::ColourMap::diverging, true},
       [](const Snapshot& s) { return displacement(s, 1); }},
  };
  return list;
}

const Entry& entry(const std::string& name) {
  for (const Entry& e : entries())
    if (e.info.name == name) return e;
  throw InputError(fmt::format("there is no field '{}'", name));
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
  Field values = e.values(shot);
  if (!e.info.at_nodes || op.nodal) return values;
  Field at_points(static_cast<std::size_t>(op.points));
  interpolate<2>(op, values, at_points, 0, at_points.size());
  return at_points;
}

Field values_at_nodes(const Snapshot& shot, const std::string& name) {
  const Entry& e = entry(name);
  const DiscreteOperators<2>& op = shot.approximation.mechanics;
  Field values = e.values(shot);
  return e.info.at_nodes ? values : average_at_nodes<2>(op, values);
}

double boundary_area(const Snapshot& shot) {
  const Fields<2>& x = shot.state.node.position;
  double twice = 0.0;
  for (const Facet<2>& facet : shot.cloud.facets) {
    const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
    twice += x[0][a] * x[1][b] - x[1][a] * x[0][b];
  }
  return 0.5 * twice;
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

} // namespace cnem::app
