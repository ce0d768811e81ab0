#pragma once
// Enrichment of the natural-neighbour functions at crack tips in the partition-of-unity setting (paper 004,
// (74)), with the branch functions that carry both modes.
#include "core/operators/discretisation.hpp"
#include "fracture/crack_tip.hpp"
#include "fracture/williams.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

#include <cstdint>
#include <vector>

namespace cnem::fracture {

/// Operators whose columns are the nodes followed by the enrichment functions ψ = φ_J (F_k(x) − F_k(x_J)) of
/// the nodes J within a fixed radius of a tip. Shifted, they vanish at all nodes.
///
/// All cells are integrated with Gauss points on the triangles between node and cell edges: near a tip one
/// point has three strains for up to ten unknowns of a node, and further out smoothing makes the graded cells
/// around it too soft (docs/theory.md). ∇φ_J is corrected by a constant per cell so that its mean is the
/// smoothed gradient of the base: the operators stay exact on linear fields. ∇ψ is corrected by a constant on
/// its support so that its integral is the one of ψ n over the boundary: a uniform stress that the faces may
/// carry is solved exactly. Weak modes are gone, and the stabilisation with them.
struct EnrichedOperators {
  DiscreteOperators<2> operators; ///< with values at the points when there is enrichment
  std::vector<Vec2> position;     ///< [point] m; of cells their centroid
  std::vector<std::int32_t> cell; ///< [point] stress point of the base that it is part of
  StabilisationLinks<2> links;    ///< those of the base; none with Gauss points

  /// The functions of one node and tip: columns `column` to `column + 3`.
  struct Function {
    NodeIndex node;
    std::size_t tip;
    std::array<double, branch_count> shift; ///< F_k(x_J), √m
    std::int32_t column;
  };
  std::vector<Function> functions;

  int enriched_nodes() const;
};

/// `base` must be nodal (C-NEM) when there are tips with a positive radius; without, only positions are
/// added. `radius`: [tip] m, 0: the tip is left as it is.
/// Throws InputError for other methods, GeometryError when a cell at a tip cannot be integrated.
EnrichedOperators enrich(const Cloud<2>& cloud, const Approximation<2>& base,
                         const std::vector<CrackTip>& tips, const std::vector<double>& radius,
                         voronoi::Functions functions);

/// External forces on all functions: `nodal` on the nodes, tractions and body force on those that enrich.
/// `nodal`: [k][node] N/m; `body_force`: N/m³.
Fields<2> forces_on_functions(const EnrichedOperators& enriched, const std::vector<CrackTip>& tips,
                              const Fields<2>& nodal, const std::vector<FacetLoad>& loads,
                              const Vec2& body_force);

} // namespace cnem::fracture
