#pragma once
// The surface of a body keeps its resolution: long edges are split, short ones collapsed, and facets made
// Delaunay by flips.
#include "adapt/pass_report.hpp"
#include "adapt/space/periods.hpp"
#include "adapt/space/working_surface.hpp"
#include "core/fields/aligned.hpp"

#include <array>
#include <span>
#include <vector>

namespace cnem::adapt {

/// Lengths in units of the wanted spacing h at the place, wider at sharp creases
/// (adapt/space/sharp_creases.hpp).
struct SurfaceThresholds {
  double split_edge = 1.5;  ///< longer edges are split
  double short_edge = 0.45; ///< shorter ones collapsed
  double low_height = 0.3;  ///< nodes nearer to a crease go into one of its nodes
  double light = 0.01;      ///< nodes with less matter (in h³) that hold next to nothing of the shape go
  double give_back = 0.1;   ///< how far a node moves at most to give back volume
  int rounds = 3;
};

/// What has become of nodes.
struct RefinedSurface {
  std::vector<std::array<NodeIndex, 2>> made; ///< the ends of the edges that were split, node after node
  IndexedVector<NodeIndex, NodeIndex> into;   ///< [node] the one it went into; none: it is there
};

/// size: m, [node] wanted spacing, of new nodes too afterwards; matter: m³, [node] volume of what it has.
/// Volume that collapses and flips change is given back by moving nodes near them along the gradient of the
/// volume, not out of plane faces: only what creases and corners cannot give back is left. Images across
/// periods change together. O(F log F). The result depends on the arguments alone.
RefinedSurface refine_surface(WorkingSurface& surface, Field& size, const Field& matter,
                              const SurfaceThresholds& limits, PassReport& report,
                              const PeriodImages& images);

/// Moves nodes along the gradient of the volume by `most` h at most, so that each wins the volume that it
/// owes, debt[node] in m³; who cannot leaves it to nodes beside, and `further` to those beyond where none of
/// these can either.
void give_back(WorkingSurface& surface, Field debt, const Field& size, double most, bool further = false);
/// The surface of a cloud that encloses `volume` (m³) more, as far as give_back() can, of which nodes of a
/// list take equal shares. fixed: [node] those that stay.
WorkingSurface swollen_by(double volume, const Cloud<3>& cloud, std::span<const NodeIndex> giving,
                          const IndexedVector<NodeIndex, char>& fixed, const Field& size,
                          const SurfaceRules& rules, double most);

} // namespace cnem::adapt
