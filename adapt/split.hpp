#pragma once
// Separation: the cloud is opened along Delaunay edges whose ends are broken. Nodes are doubled, nothing is
// deleted.
#include "adapt/working_cloud.hpp"

namespace cnem::adapt {

struct SplitRules {
  std::int32_t piece = -1; ///< index of the boundary piece that new faces belong to
  double gap = 1e-3;       ///< of the spacing: how far the two faces are set apart, so that no nodes coincide
  double clear = 1.5;      ///< of the spacing: no new crack starts nearer than this to a face of another one
  double turn = 75.0;      ///< degrees: a crack turns by less than this from one edge to the next
  int most = 8;            ///< edges opened in one pass
};

struct SplitReport {
  int opened = 0;           ///< edges
  int separated = 0;        ///< edges that joined two boundaries: a part came loose, or a hole opened
  double area_change = 0.0; ///< m²
};

/// Opens edges between broken nodes, from the boundary or a tip inwards, the most broken first. broken:
/// [node] ≥ 1 where the material can carry nothing any more. Matter of a doubled node is shared out by the
/// volumes of its two cells. Does nothing, and says so by `opened` = 0, when the opened cloud had no valid
/// structure.
Resampling<2> split(const Cloud<2>& cloud, NodeProperties properties, const Field& broken,
                    const SplitRules& rules, SplitReport& report);

} // namespace cnem::adapt
