#pragma once
// Heat through the boundary: prescribed temperature, flux, convection, conductance to tools.
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/operators/resampling.hpp"
#include "core/time_table.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cnem {

/// Nodes held at a temperature, K.
struct FixedTemperature {
  std::string name;
  TimeTable value;
  std::vector<NodeIndex> nodes;
  std::vector<PieceIndex> pieces{}; ///< boundary pieces whose nodes are all held, also new ones
};

/// Heat flux into the body, W/m² of current boundary.
template<int dim> struct HeatFlux {
  std::string name;
  TimeTable value;
  std::vector<Facet<dim>> facets;
};

/// Exchange with surroundings.
struct ConvectionLaw {
  std::string name;
  TimeTable coefficient; ///< W/(m² K)
  TimeTable ambient;     ///< K
};
template<int dim> struct Convection : ConvectionLaw { std::vector<Facet<dim>> facets; };

/// Exchange with a coolant of the whole boundary, faces that a cut makes included, where it touches nothing.
template<int dim> struct Coolant : ConvectionLaw {
  std::optional<std::array<Vec<dim>, 2>> box; ///< m, lower and upper corner at t = 0; none: everywhere
  ToolIndex follow = ToolIndex::none;         ///< that the box moves with
};

/// What of the boundary a coolant reaches.
template<int dim> struct Exposure {
  IndexedVector<NodeIndex, bool> covered;        ///< touch something; empty: none
  IndexedVector<ToolIndex, Vec<dim>> tool_moved; ///< m, since t = 0
};

/// Exchange between the two faces of an interface: conductance in W/(m² K).
template<int dim> struct ContactConductance {
  std::string name;
  double conductance = 0.0;
  std::vector<Facet<dim>> facets;                   ///< of one face
  std::vector<std::array<NodeIndex, dim>> opposite; ///< [facet] the nodes of the other face at its ends
};

/// Exchange of one boundary node with a tool it touches, over the given area (m^(dim−1)).
struct ToolConductance {
  NodeIndex node;
  double conductance; ///< W/(m² K)
  double area;
  double tool_temperature; ///< K
};

/// Exchange of one boundary node with a place on a facet of the workpiece that it touches.
template<int dim> struct BodyConductance {
  NodeIndex node;
  std::array<NodeIndex, dim> facet; ///< its nodes
  std::array<double, dim> weight;   ///< of these
  double conductance;               ///< W/(m² K)
  double area;                      ///< m^(dim−1)
};

/// What touches in a step.
template<int dim> struct HeatContacts {
  std::vector<ToolConductance> tools;
  std::vector<BodyConductance<dim>> bodies;

  void clear() {
    tools.clear();
    bodies.clear();
  }
  bool empty() const { return tools.empty() && bodies.empty(); }
  /// Adds what flows into the nodes to `flow`, W/m^(3−dim).
  void add_flow(const Field& temperature, Field& flow) const;
  /// visit(node) for every node that takes part, some of them several times.
  template<class Visit> void each_node(Visit&& visit) const {
    for (const ToolConductance& tool : tools) visit(tool.node);
    for (const BodyConductance<dim>& body : bodies) {
      visit(body.node);
      for (const NodeIndex node : body.facet) visit(node);
    }
  }
  /// Largest share these add to the decay rate of a node, 1/s.
  double fastest_decay(const Field& heat_capacity) const;
};

/// All thermal boundary conditions; a boundary that none names is insulated.
template<int dim> class ThermalBoundaries {
public:
  ThermalBoundaries() = default;
  ThermalBoundaries(std::vector<FixedTemperature> fixed, std::vector<HeatFlux<dim>> fluxes,
                    std::vector<Convection<dim>> convections, Space space = Space::plane,
                    std::vector<ContactConductance<dim>> interfaces = {})
      : fixed_(std::move(fixed)), fluxes_(std::move(fluxes)), convections_(std::move(convections)),
        interfaces_(std::move(interfaces)), space_(space) {}

  /// Coolants on the boundary of a cloud, which they follow.
  void cool(std::vector<Coolant<dim>> coolants, const Cloud<dim>& cloud);
  bool cooled() const { return !coolants_.empty(); }

  /// A list of nodes with those that have one temperature with them.
  using WithPartners = std::function<std::vector<NodeIndex>(std::vector<NodeIndex>)>;
  /// Acts on a changed cloud, whose mates are the faces of interfaces.
  void resample(const Resampling<dim>& change, const WithPartners& with_partners);
  void resample(const Cloud<dim>& cloud);
  /// Carries the lists of nodes of a resampled cloud out or in.
  void archive_nodes(Archive& archive);

  /// Adds what flows into the nodes at `time` to `flow`, W/m^(3−dim).
  void add_flow(double time, const Fields<dim>& position, const Field& temperature, Field& flow) const;
  /// The same of coolants.
  void add_coolant_flow(double time, const Exposure<dim>& exposure, const Fields<dim>& position,
                        const Field& temperature, Field& flow) const;

  /// set(node, temperature) for every node that is held, K at `time`.
  template<class Set> void hold(double time, Set&& set) const {
    for (const FixedTemperature& fixed : fixed_) {
      const double value = fixed.value(time);
      for (const NodeIndex node : fixed.nodes) set(node, value);
    }
  }

  /// Largest share the exchange adds to the decay rate Q/(C T) of a node, 1/s.
  double fastest_decay(double time, const Fields<dim>& position, const Field& heat_capacity) const;

private:
  std::vector<FixedTemperature> fixed_;
  std::vector<HeatFlux<dim>> fluxes_;
  std::vector<Convection<dim>> convections_;
  std::vector<ContactConductance<dim>> interfaces_;
  std::vector<Coolant<dim>> coolants_;
  std::vector<Facet<dim>> boundary_; ///< all of it, where there are coolants
  Space space_ = Space::plane;
};

extern template struct HeatContacts<2>;
extern template struct HeatContacts<3>;
extern template class ThermalBoundaries<2>;
extern template class ThermalBoundaries<3>;

} // namespace cnem
