#pragma once
// What a method has to provide to be solved with: one virtual call per rebuild, none inside a loop over
// nodes.
#include "core/geometry/cloud.hpp"
#include "core/operators/operators.hpp"
#include "core/operators/parcels.hpp"
#include "core/operators/promises.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cnem {

/// Neighbour links on which nodal integration is stabilised (docs/theory.md, "edge defect"), node by node:
/// each link stands in the lists of both its ends. Empty for methods that need none.
template<int dim> struct StabilisationLinks {
  std::vector<std::int32_t> begin;  ///< [node + 1]
  std::vector<NodeIndex> neighbour; ///< [link]
  /// [link] area of the face between two cells over their distance: in the plane L_ij/d_ij, clamped to
  /// [0.1, 2], –, of revolution times 2π r, m; in space A_ij/d_ij, clamped to [0.05, 2] d_ij, m.
  Field weight;
};

/// Cells of the stress points, for output and pictures: polygons in the plane, tetrahedra in space.
template<int dim> struct CellGeometry {
  /// The cells are not those of the stress points but simplices between them: vertex v is node and point v.
  bool between_points = false;
  std::vector<Vec<dim>> vertex;    ///< m, in the reference
  std::vector<std::int32_t> begin; ///< [point + 1]
  std::vector<std::int32_t> index; ///< vertices of each cell, counter-clockwise in the plane

  // How a vertex moves with the nodes: x_v = Σ weight x_node. Rows on the pattern below.
  std::vector<std::int32_t> vertex_begin; ///< [vertex + 1]
  std::vector<NodeIndex> vertex_node;
  std::vector<double> vertex_weight;
};

/// All operators of one reference configuration.
template<int dim> struct Approximation {
  DiscreteOperators<dim> mechanics;
  DiscreteOperators<dim>
      conduction; ///< the operators heat conducts with: free of weak modes (docs/theory.md)
  StabilisationLinks<dim> links;
  Field node_volume; ///< [node] share of volume Σ_p V_p N_pJ, m² or m³: ρ0 times it is the mass
  CellGeometry<dim> cells;
};

/// A method: turns a cloud into operators.
template<int dim> class Discretisation {
public:
  virtual ~Discretisation() = default;

  /// Builds all operators on the cloud as it stands (positions are the new reference).
  /// Throws GeometryError when the cloud has no valid structure. May keep the last structure as a hint for
  /// speed, but the result depends on the cloud alone.
  virtual Approximation<dim> rebuild(const Cloud<dim>& cloud) = 0;

  /// The same, but that the transpose of `mechanics` may be yet to be built (it has no points then): it takes
  /// as much memory as the rows, which whoever holds a former approximation meanwhile can do without.
  virtual Approximation<dim> rebuild_rows(const Cloud<dim>& cloud) { return rebuild(cloud); }

  /// Of what matter the points of `now` are, which was built on `cloud`: of each point of `old`, built on the
  /// same nodes elsewhere, the fractions that they take where the nodes are now, so that Σ_p f_pk = 1. A
  /// point that is in both has the row {itself, 1}. Empty where points are those of nodes, which stay what
  /// they are. For methods that promise carried_history. Throws GeometryError where the two do not fill the
  /// same domain.
  virtual std::optional<PointRows> point_parcels(const DiscreteOperators<dim>& /*old*/,
                                                 const DiscreteOperators<dim>& /*now*/,
                                                 const Cloud<dim>& /*cloud*/) const {
    return std::nullopt;
  }

  virtual std::string name() const = 0;

  /// What `Approximation::mechanics` keeps beyond the invariants of core/operators/operators.hpp. The
  /// operators of conduction have non-negative values, tile the domain and balance constant fluxes, whatever
  /// the method.
  virtual Promises promises() const = 0;
};

} // namespace cnem
