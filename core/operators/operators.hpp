#pragma once
// The contract of the whole design: a discretisation is a pair of rectangular sparse operators, gradient G
// and values N, whose rows are stress points and whose columns are nodes. Solver, heat and contact see
// nothing else.
#include "core/fields/aligned.hpp"
#include "core/geometry/revolution.hpp"
#include "core/indexed.hpp"

#include <cstdint>
#include <vector>

namespace cnem {

/// The stress point of a node and the node of a stress point where row p is node p: with nodal operators and
/// methods of one point per node (core/operators/promises.hpp).
constexpr PointIndex point_of(NodeIndex node) { return as<PointIndex>(index_of(node)); }
constexpr NodeIndex node_of(PointIndex point) { return as<NodeIndex>(index_of(point)); }

/// Sparse gradient G and value N operators in CSR form, and their transpose for gather-only assembly.
///
/// Row p holds b_pJ = ∇φ_J averaged over the volume V_p of stress point p (paper 004, (75)–(79)) and N_pJ, on
/// the same pattern. Invariants (tests/contract): Σ_J b_pJ = 0; Σ_J x_J ⊗ b_pJ = 1; Σ_J N_pJ = 1. What else
/// holds a method promises (core/operators/promises.hpp).
///
/// Bodies of revolution add the hoop rows h_pJ = N_pJ/r̄_p, N_pJ = φ_J at the centroid of the cell: Σ_J h_pJ
/// r_J = r/R. There V_p = 2π r̄_p A_p, and b_pJ is weighted with the radius: V_p b_pJ = 2π (∮ r φ_J n dΓ − e_r
/// A_p N_pJ).
template<int dim> struct DiscreteOperators {
  int points = 0;
  int nodes = 0;
  bool nodal = false; ///< rows are nodes and N is the identity (C-NEM); then `value` is empty

  Field volume; ///< [point] V_p in the reference: m² (per unit thickness), m³ in 3D and of revolution
  std::vector<std::int32_t> row_begin; ///< [point + 1]
  std::vector<NodeIndex> node;         ///< [entry]
  Fields<dim> gradient;                ///< [k][entry] b_pJ,k, 1/m
  Field value;                         ///< [entry] N_pJ; empty when nodal, and in statics
  Field radius;                        ///< [point] r̄_p of the centroid, m; empty in plane problems
  Field hoop;                          ///< [entry] h_pJ, 1/m; empty in plane problems

  // The transpose, weighted by volume. Entries of a column are in increasing order of the point.
  std::vector<std::int32_t> col_begin; ///< [node + 1]
  std::vector<PointIndex> point;       ///< [entry]
  Fields<dim> weighted_gradient;       ///< [k][entry] V_p b_pJ,k
  Field weighted_value;                ///< [entry] V_p N_pJ; empty when nodal
  Field weighted_hoop;                 ///< [entry] V_p h_pJ; empty in plane problems

  bool of_revolution() const { return !radius.empty(); }
  Space space() const { return of_revolution() ? Space::revolution : Space::plane; }

  /// A node of the row of a point, its own for nodal rows: all of a row are of one body and one material.
  NodeIndex first_node(std::size_t p) const {
    return nodal ? node_of(as<PointIndex>(p)) : node[index_of(row_begin[p])];
  }

  /// Fills the transpose from the rows. To be called once the rows are complete.
  void build_transpose();
  /// Of the transpose `col_begin` alone.
  void begin_columns();

  /// Σ_p V_p N_pJ, the share of the volume each node carries: ρ times it is the lumped mass. m² or m³.
  Field node_volume() const;
};

extern template struct DiscreteOperators<2>;
extern template struct DiscreteOperators<3>;

} // namespace cnem
