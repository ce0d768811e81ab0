#include "mechanics/field_catalogue.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/kinematics.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <string_view>

namespace cnem {

namespace {

/// Cauchy stress σ = P Fᵀ/det F at a point; i = j = 2 in the plane: out of it.
template<int dim> double cauchy(const PointState<dim>& point, std::size_t i, std::size_t j, std::size_t p) {
  constexpr std::size_t n = dim, out_of_plane = 4;
  double stress = 0.0;
  if (i >= n)
    stress = point.piola[out_of_plane][p] * point.deformation[out_of_plane][p];
  else
    for (std::size_t k = 0; k < n; ++k) {
      const double part = point.piola[n * i + k][p] * point.deformation[n * j + k][p];
      stress = k == 0 ? part : stress + part;
    }
  return stress / jacobian<dim>(point.deformation, p);
}

/// Volume ratio J of the present to the stress-free configuration.
template<int dim> double volume_ratio(const PointState<dim>& point, std::size_t p) {
  return jacobian<dim>(point.deformation, p) / point.stress_free[p];
}

constexpr std::array<std::array<std::size_t, 2>, 6> stress_components{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Principal values of the Cauchy stress, the largest first, Pa.
template<int dim> Vec3 principal_stresses(const PointState<dim>& point, std::size_t p) {
  Mat<3> stress = Mat<3>::Zero();
  for (std::size_t k = 0; k < index_of(symmetric_size<dim>); ++k) {
    const auto i = as<int>(stress_components[k][0]), j = as<int>(stress_components[k][1]);
    stress(i, j) = stress(j, i) = cauchy<dim>(point, stress_components[k][0], stress_components[k][1], p);
  }
  if (!stress.allFinite()) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return Eigen::SelfAdjointEigenSolver<Mat<3>>(stress, Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

/// Mean over equivalent stress, as damage laws take it; 0 where the stress is no more than rounding.
template<int dim> double triaxiality(const PointState<dim>& point, std::size_t p) {
  constexpr double least = 1e3; // Pa
  return point.equivalent_stress[p] > least ? -point.pressure[p] / point.equivalent_stress[p] : 0.0;
}

/// Words for users, which have to last as long as the catalogue.
struct ComponentWords {
  const char *name, *label, *meaning;
};
constexpr std::array stress_words{
    ComponentWords{"stress_xx", "stress xx", "Cauchy stress, component xx"},
    ComponentWords{"stress_yy", "stress yy", "Cauchy stress, component yy"},
    ComponentWords{"stress_zz", "stress zz", "Cauchy stress, component zz, in the plane that out of it"},
    ComponentWords{"stress_xy", "stress xy", "Cauchy stress, component xy"},
    ComponentWords{"stress_yz", "stress yz", "Cauchy stress, component yz"},
    ComponentWords{"stress_zx", "stress zx", "Cauchy stress, component zx"}};
constexpr std::array principal_words{
    ComponentWords{"principal_stress_1", "principal stress 1",
                   "Largest principal value of the Cauchy stress"},
    ComponentWords{"principal_stress_2", "principal stress 2", "Middle principal value of the Cauchy stress"},
    ComponentWords{"principal_stress_3", "principal stress 3", "Least principal value of the Cauchy stress"}};
constexpr std::array velocity_words{ComponentWords{"velocity_x", "velocity x", "Velocity along x"},
                                    ComponentWords{"velocity_y", "velocity y", "Velocity along y"},
                                    ComponentWords{"velocity_z", "velocity z", "Velocity along z"}};
constexpr std::array displacement_words{
    ComponentWords{"displacement_x", "displacement x", "Displacement along x"},
    ComponentWords{"displacement_y", "displacement y", "Displacement along y"},
    ComponentWords{"displacement_z", "displacement z", "Displacement along z"}};

ArrayPart vector_part(const char* label, std::size_t component) {
  return {label, component, {"X", "Y", "Z"}};
}
ArrayPart stress_part(std::size_t component) {
  return {"stress", component, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}}; // as ParaView orders them
}
ArrayPart principal_part(std::size_t component) { return {"principal stresses", component, {"1", "2", "3"}}; }

/// Fields that are functions of others.
template<int dim> std::vector<FieldInfo<dim>> derived_fields() {
  using Source = const FieldSource<dim>&;
  using Index = std::size_t;
  constexpr bool at_nodes = true;
  const auto stress = [](const char* label, const char* meaning) {
    return Shown{label, meaning, "MPa", 1e6, ColourMap::diverging};
  };
  std::vector<FieldInfo<dim>> list{
      {"equivalent_stress",
       "Pa",
       {"equivalent stress",
        "Von Mises equivalent of the Cauchy stress, Hill's where the material is anisotropic", "MPa", 1e6,
        ColourMap::heat},
       !at_nodes,
       false,
       false,
       [](Source s, Index p) { return s.state.point.equivalent_stress[p] / volume_ratio(s.state.point, p); }},
      {"pressure", "Pa", stress("pressure", "Pressure of the Cauchy stress, positive in compression"),
       !at_nodes, false, false,
       [](Source s, Index p) { return s.state.point.pressure[p] / volume_ratio(s.state.point, p); }}};
  for (std::size_t k = 0; k < index_of(symmetric_size<dim>); ++k) {
    const auto& words = stress_words[k];
    list.push_back({words.name, "Pa", stress(words.label, words.meaning), !at_nodes, false, false,
                    [ij = stress_components[k]](Source s, Index p) {
                      return cauchy<dim>(s.state.point, ij[0], ij[1], p);
                    },
                    stress_part(k)});
  }
  for (std::size_t k = 0; k < principal_words.size(); ++k) {
    const auto& words = principal_words[k];
    list.push_back({words.name, "Pa", stress(words.label, words.meaning), !at_nodes, false, false,
                    [k](Source s, Index p) { return principal_stresses<dim>(s.state.point, p)[as<int>(k)]; },
                    principal_part(k)});
  }
  list.push_back({"triaxiality",
                  "",
                  {"stress triaxiality", "Mean over equivalent stress", "", 1.0, ColourMap::diverging},
                  !at_nodes,
                  false,
                  false,
                  [](Source s, Index p) { return triaxiality<dim>(s.state.point, p); }});
  list.push_back({"volume_ratio",
                  "",
                  {"volume ratio J", "Present over stress-free volume", "", 1.0, ColourMap::strain},
                  !at_nodes,
                  false,
                  false,
                  [](Source s, Index p) { return volume_ratio(s.state.point, p); }});
  for (std::size_t k = 0; k < dim; ++k) {
    const auto& words = velocity_words[k];
    list.push_back({words.name,
                    "m/s",
                    {words.label, words.meaning, "m/s", 1.0, ColourMap::diverging},
                    at_nodes,
                    false,
                    false,
                    [k](Source s, Index i) { return s.state.node.velocity[k][i]; },
                    vector_part("velocity", k),
                    [k](Source s) { return &s.state.node.velocity[k]; }});
  }
  for (std::size_t k = 0; k < dim; ++k) {
    const auto& words = displacement_words[k];
    list.push_back(
        {words.name,
         "m",
         {words.label, words.meaning, "mm", 1e-3, ColourMap::diverging},
         at_nodes,
         false,
         false,
         [k](Source s, Index i) { return s.state.node.position[k][i] - s.state.node.initial_position[k][i]; },
         vector_part("displacement", k)});
  }
  return list;
}

/// Adds the fields of a group that are declared as shown; `table` finds the group in a source, null: it is
/// not there. Fields of a group that is off are zero.
template<int dim, class Table>
void add_shown(std::vector<FieldInfo<dim>>& list, const FieldTable& declared, bool at_nodes, bool adaptive,
               Table table) {
  for (std::size_t k = 0; k < declared.entries().size(); ++k) {
    const FieldLine& line = declared.entries()[k].line;
    if (!line.shown.label) continue;
    const auto kept = [table, k](const FieldSource<dim>& source) -> const Field* {
      return table(source).entries()[k].component;
    };
    list.push_back({line.name,
                    std::string_view(line.unit) == "1" ? "" : line.unit,
                    line.shown,
                    at_nodes,
                    adaptive,
                    !declared.on(),
                    [kept](const FieldSource<dim>& source, std::size_t i) {
                      const Field& values = *kept(source);
                      return values.empty() ? 0.0 : values[i];
                    },
                    {},
                    kept});
  }
}

} // namespace

template<int dim> const std::vector<FieldInfo<dim>>& field_catalogue() {
  static const std::vector<FieldInfo<dim>> list = [] {
    std::vector<FieldInfo<dim>> fields;
    const State<dim> state;
    const AdaptationFields adaptation;
    using Source = const FieldSource<dim>&;
    using Table = const FieldTable&;
    add_shown(fields, state.node.table, true, false, [](Source s) -> Table { return s.state.node.table; });
    add_shown(fields, state.point.table, false, false, [](Source s) -> Table { return s.state.point.table; });
    for (FieldInfo<dim>& derived : derived_fields<dim>()) fields.push_back(std::move(derived));
    add_shown(fields, state.point.damaged, false, false,
              [](Source s) -> Table { return s.state.point.damaged; });
    if constexpr (dim == 2) {
      add_shown(fields, state.point.thin, false, false, [](Source s) -> Table { return s.state.point.thin; });
      add_shown(fields, state.point.fibrous, false, false,
                [](Source s) -> Table { return s.state.point.fibrous; });
      add_shown(fields, state.point.failing, false, false,
                [](Source s) -> Table { return s.state.point.failing; });
      add_shown(fields, adaptation.table, true, true, [](Source s) -> Table { return s.adaptation->table; });
    }
    return fields;
  }();
  return list;
}

template<int dim> const FieldInfo<dim>& field_info(const std::string& name) {
  for (const FieldInfo<dim>& info : field_catalogue<dim>())
    if (info.name == name) return info;
  throw InputError(fmt::format("there is no field '{}'", name));
}

template const std::vector<FieldInfo<2>>& field_catalogue();
template const std::vector<FieldInfo<3>>& field_catalogue();
template const FieldInfo<2>& field_info(const std::string& name);
template const FieldInfo<3>& field_info(const std::string& name);

} // namespace cnem
