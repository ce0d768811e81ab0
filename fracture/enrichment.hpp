#pragma once
// Enrichment of the natural-neighbour functions at crack tips in the partition-of-unity setting (paper 004,
// (74)), with the branch functions that carry both modes.
#include "core/discretisation.hpp"
#include "fracture/crack_tip.hpp"
#include "voronoi/natural_neighbours.hpp"

#include <cstdint>
#include <vector>

namespace cnem::fracture {

/// Operators whose columns are the nodes followed by the enrichment functions ψ = φ_J (F_k(x) − F_k(x_J)) of
/// the nodes J within a fixed radius of a tip. Shifted, they vanish at all nodes.
///
/// All cells are integrated with Gauss points on the triangles between node and cell edges: near a tip one
/// point has three strains for up to ten unknowns of a node, and further out smoothing makes the graded cells
/// around it too soft (docs/theory.md). ∇φ_J is corrected by a constant per cell so that its mean is the
/// smoothed gradient of the base: the operators stay exact on linear fields and keep the patch test. Weak
/// modes are gone, and the stabilisation with them.
struct EnrichedOperators {
  DiscreteOperators<2> operators;
  std::vector<Vec2> position;     ///< [point] m; of cells their centroid
  std::vector<std::int32_t> cell; ///< [point] stress point of the base that it is part of
  StabilisationLinks<2> links;    ///< those of the base; none with Gauss points
  int enriched_nodes = 0;
};

/// `base` must be nodal (C-NEM) when there are tips with a positive radius; without, only positions are
/// added. `radius`: [tip] m, 0: the tip is left as it is.
/// Throws InputError for other methods, GeometryError when a cell at a tip cannot be integrated.
EnrichedOperators enrich(const Cloud<2>& cloud, const Approximation<2>& base,
                         const std::vector<CrackTip>& tips, const std::vector<double>& radius,
                         voronoi::Functions functions);

} // namespace cnem::fracture
