#include "mechanics/field_catalogue.hpp"

#include "core/error.hpp"
#include "mechanics/kinematics.hpp"

#include <fmt/format.h>
#include <string_view>

namespace cnem {

namespace {

/// Cauchy stress σ = P Fᵀ/det F at a point; components i, j of the plane, or zz for i = j = 2.
double cauchy(const PointState<2>& point, std::size_t i, std::size_t j, std::size_t p) {
  const double J = jacobian<2>(point.deformation, p);
  return i == 2 ? point.piola[4][p] * point.deformation[4][p] / J
                : (point.piola[2 * i][p] * point.deformation[2 * j][p] +
                   point.piola[2 * i + 1][p] * point.deformation[2 * j + 1][p]) /
                      J;
}

/// Volume ratio J of the present to the stress-free configuration.
double volume_ratio(const PointState<2>& point, std::size_t p) {
  return jacobian<2>(point.deformation, p) / point.stress_free[p];
}

double displacement(const NodeState<2>& node, std::size_t k, std::size_t i) {
  return node.position[k][i] - node.initial_position[k][i];
}

/// Fields that are functions of others.
std::vector<FieldInfo> derived_fields() {
  using Source = const FieldSource&;
  using Index = std::size_t;
  constexpr bool at_nodes = true;
  const auto stress = [](const char* label, const char* meaning) {
    return Shown{label, meaning, "MPa", 1e6, ColourMap::diverging};
  };
  return {
      {"equivalent_stress",
       "Pa",
       {"von Mises stress", "Von Mises equivalent of the Cauchy stress", "MPa", 1e6, ColourMap::heat},
       !at_nodes,
       false,
       false,
       [](Source s, Index p) { return s.state.point.equivalent_stress[p] / volume_ratio(s.state.point, p); }},
      {"pressure", "Pa", stress("pressure", "Pressure of the Cauchy stress, positive in compression"),
       !at_nodes, false, false,
       [](Source s, Index p) { return s.state.point.pressure[p] / volume_ratio(s.state.point, p); }},
      {"stress_xx", "Pa", stress("stress xx", "Cauchy stress, component xx"), !at_nodes, false, false,
       [](Source s, Index p) { return cauchy(s.state.point, 0, 0, p); }},
      {"stress_yy", "Pa", stress("stress yy", "Cauchy stress, component yy"), !at_nodes, false, false,
       [](Source s, Index p) { return cauchy(s.state.point, 1, 1, p); }},
      {"stress_zz", "Pa", stress("stress zz", "Cauchy stress, out of plane"), !at_nodes, false, false,
       [](Source s, Index p) { return cauchy(s.state.point, 2, 2, p); }},
      {"stress_xy", "Pa", stress("stress xy", "Cauchy stress, component xy"), !at_nodes, false, false,
       [](Source s, Index p) { return cauchy(s.state.point, 0, 1, p); }},
      {"volume_ratio",
       "",
       {"volume ratio J", "Present over stress-free volume", "", 1.0, ColourMap::strain},
       !at_nodes,
       false,
       false,
       [](Source s, Index p) { return volume_ratio(s.state.point, p); }},
      {"velocity_x",
       "m/s",
       {"velocity x", "Velocity along x", "m/s", 1.0, ColourMap::diverging},
       at_nodes,
       false,
       false,
       [](Source s, Index i) { return s.state.node.velocity[0][i]; }},
      {"velocity_y",
       "m/s",
       {"velocity y", "Velocity along y", "m/s", 1.0, ColourMap::diverging},
       at_nodes,
       false,
       false,
       [](Source s, Index i) { return s.state.node.velocity[1][i]; }},
      {"displacement_x",
       "m",
       {"displacement x", "Displacement along x", "mm", 1e-3, ColourMap::diverging},
       at_nodes,
       false,
       false,
       [](Source s, Index i) { return displacement(s.state.node, 0, i); }},
      {"displacement_y",
       "m",
       {"displacement y", "Displacement along y", "mm", 1e-3, ColourMap::diverging},
       at_nodes,
       false,
       false,
       [](Source s, Index i) { return displacement(s.state.node, 1, i); }},
  };
}

/// Adds the fields of a group that are declared as shown; `table` finds the group in a source, null: it is
/// not there. Fields of a group that is off are zero.
template<class Table>
void add_shown(std::vector<FieldInfo>& list, const FieldTable& declared, bool at_nodes, bool adaptive,
               Table table) {
  for (std::size_t k = 0; k < declared.entries().size(); ++k) {
    const FieldLine& line = declared.entries()[k].line;
    if (!line.shown.label) continue;
    list.push_back({line.name, std::string_view(line.unit) == "1" ? "" : line.unit, line.shown, at_nodes,
                    adaptive, !declared.on(), [table, k](const FieldSource& source, std::size_t i) {
                      const Field& values = *table(source).entries()[k].component;
                      return values.empty() ? 0.0 : values[i];
                    }});
  }
}

} // namespace

const std::vector<FieldInfo>& field_catalogue() {
  static const std::vector<FieldInfo> list = [] {
    std::vector<FieldInfo> fields;
    const State<2> state;
    const AdaptationFields adaptation;
    using Source = const FieldSource&;
    using Table = const FieldTable&;
    add_shown(fields, state.node.table, true, false, [](Source s) -> Table { return s.state.node.table; });
    add_shown(fields, state.point.table, false, false, [](Source s) -> Table { return s.state.point.table; });
    for (FieldInfo& derived : derived_fields()) fields.push_back(std::move(derived));
    add_shown(fields, state.point.damaged, false, false,
              [](Source s) -> Table { return s.state.point.damaged; });
    add_shown(fields, adaptation.table, true, true, [](Source s) -> Table { return s.adaptation->table; });
    return fields;
  }();
  return list;
}

const FieldInfo& field_info(const std::string& name) {
  for (const FieldInfo& info : field_catalogue())
    if (info.name == name) return info;
  throw InputError(fmt::format("there is no field '{}'", name));
}

} // namespace cnem
