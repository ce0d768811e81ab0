#pragma once
// A tool that conducts: the nodes of its section, what heat they hold and where it is exchanged.
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"
#include "core/heat_curves.hpp"
#include "core/operators/discretisation.hpp"
#include "core/parameter.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem {

/// A layer on the faces of a tool, much thinner than the distance of its nodes, across which heat flows.
struct ToolCoating {
  double thickness = 0.0, conductivity = 0.0, density = 0.0, specific_heat = 0.0;

  static constexpr Parameter<ToolCoating> parameters[] = {{&ToolCoating::thickness,
                                                           {.name = "thickness",
                                                            .unit = "m",
                                                            .range = positive,
                                                            .required = true,
                                                            .meaning = "Of the layer.",
                                                            .example = "5 um"}},
                                                          {&ToolCoating::conductivity,
                                                           {.name = "conductivity",
                                                            .unit = "W/(m K)",
                                                            .range = positive,
                                                            .required = true,
                                                            .meaning = "Of the layer.",
                                                            .example = "12 W/(m K)"}},
                                                          {&ToolCoating::density,
                                                           {.name = "density",
                                                            .unit = "kg/m3",
                                                            .range = positive,
                                                            .required = true,
                                                            .meaning = "Of the layer.",
                                                            .example = "4700 kg/m3"}},
                                                          {&ToolCoating::specific_heat,
                                                           {.name = "specific_heat",
                                                            .unit = "J/(kg K)",
                                                            .range = positive,
                                                            .required = true,
                                                            .meaning = "Of the layer.",
                                                            .example = "600 J/(kg K)"}}};
};

/// Place on the faces of a section: on a facet, between its ends.
template<int dim> struct FacePlace {
  std::array<NodeIndex, dim> node{};
  std::array<double, dim> weight{};
};

/// What does not change while heat goes through a tool, in the frame of the tool at t = 0. A coating has a
/// node of its own over each node of the boundary, in the middle of the layer: `coating_node` says which, and
/// heat flows between the two through half the layer.
template<int dim> struct ToolSection {
  std::string name;            ///< of the tool
  ToolIndex tool{};            ///< whose it is
  double conductance = 0.0;    ///< W/(m² K), of the closed contact with the workpiece
  double temperature = 293.15; ///< K, at t = 0, and of the nodes that are held
  Cloud<dim> cloud;
  Approximation<dim> approximation; ///< of which heat needs `conduction`, and pictures the cells
  double conductivity = 0.0;        ///< W/(m K)
  HeatCurves heat_curves;           ///< factors of conductivity and heat capacity, but for a coating
  Field heat_capacity; ///< [node] J/(K m^(3−dim)), those of a coating behind those of the cloud
  std::vector<NodeIndex> held;
  std::optional<ToolCoating> coating;
  IndexedVector<NodeIndex, NodeIndex> coating_node; ///< [node of the cloud]; none inside
  Field through_coating; ///< [node of the cloud] W/(K m^(3−dim)) between a node and that of its coating

  /// Makes heat capacities and the nodes of the coating: ρc (J/(m³ K)) of the tool, times a factor.
  void complete(double capacity_per_volume, double factor, Space space);

  std::size_t nodes() const { return heat_capacity.size(); }
  const HeatCurves& curves_of(std::size_t node) const {
    static const HeatCurves none;
    return node < cloud.position.size() ? heat_curves : none;
  }
  /// W/(m² K) between the workpiece and a node of the face: of the contact, and of half the coating.
  double contact_conductance() const;
  /// The place on the faces that is nearest to x (m, as the tool stood at t = 0): nodes of the coating where
  /// there is one.
  FacePlace<dim> nearest_on_faces(const Vec<dim>& x) const;
};

template<> FacePlace<2> ToolSection<2>::nearest_on_faces(const Vec2& x) const;
extern template struct ToolSection<2>;

} // namespace cnem
