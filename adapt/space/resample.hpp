#pragma once
// The resampling pass in space: the surface keeps its resolution, inner nodes that crowd go, gaps are filled,
// and mass and volume are brought together again (docs/theory.md, "Resampling").
#include "adapt/balance.hpp"
#include "adapt/pass_report.hpp"
#include "adapt/space/refine_surface.hpp"
#include "adapt/space/separate.hpp"
#include "adapt/space/structure.hpp"
#include "adapt/space/working_body.hpp"

#include <vector>

namespace cnem::adapt {

/// Lengths are in units of the wanted spacing h at the place, the edge of a cube for each node.
struct SpaceThresholds {
  SurfaceThresholds surface{};
  double pair = 0.5;        ///< of two nodes nearer to each other one goes
  double near_facet = 0.35; ///< an inner node nearer to a facet goes
  double dense = 0.25;      ///< an inner node with less volume goes (in h³)
  double long_edge = 1.75;  ///< longer Delaunay edges get a node: above the diagonal of a cube
  double clear_node = 0.7;  ///< least distance of a new node from others
  double clear_facet = 0.5; ///< and from facets
  double light = 0.8;       ///< ρ₀V/(mJ) below which a node gives mass away
  double heavy = 1.25;      ///< and above which it takes some
  int rounds = 2;           ///< of insertion
  int sweeps = 8;           ///< of exchange
};

struct SpaceRules {
  scni::CellKind cells = scni::CellKind::median; ///< whose volumes matter has to fill
  SurfaceRules surface{};
  SpaceThresholds thresholds{};
  SeparationRules separation{}; ///< where NodeProperties::broken is given
  /// Pieces of which the second is a shifted copy of the first: they stay so, node by node. Nodes on them
  /// come and go together and never move, but where a side is cut anew nodes come to it, or are left by it
  /// (recut_sides()). Nothing may be broken then.
  std::vector<Period> periods{};
};

/// Resamples a cloud. Conserves Σ of every quantity carried in parcels to rounding; a node that nothing
/// happened to keeps its bits. Nodes that are held neither move nor go. The volume of the body changes only
/// where creases that are bent lose nodes. The boundary is one that voronoi::triangulate() takes. The result
/// depends on the arguments alone. O(N log N). Throws GeometryError, naming nodes, where the boundary crosses
/// itself or cannot be recovered.
Resampling<3> resample(const Cloud<3>& cloud, NodeProperties properties, const SpaceRules& rules,
                       PassReport& report);

// The parts of a pass.

/// A node that goes, and one beside it that stays or goes itself: its matter stays near that one.
struct Removal {
  NodeIndex gone, near;
};

/// Adds to those that go inner nodes that are outside, in diametral balls of facets or nearer to them than
/// near_facet, or too near each other; in the order of their numbers.
std::vector<Removal> crowded(const WorkingBody& body, const std::vector<Removal>& list,
                             const SpaceThresholds& limits, PassReport& report);
/// Takes nodes out, triangulates what is left, and leaves their matter to nodes beside them that have more
/// volume than matter. What recovering the boundary takes out goes the same way, and the volume that it
/// changes is given back.
void remove(WorkingBody& body, SpaceStructure& structure, const std::vector<Removal>& list,
            const SpaceRules& rules, PassReport& report);
/// One round of insertion in the middle of long edges, and of removal of inner nodes with too little volume,
/// and of those of a list; false when there was nothing to do.
bool fill(WorkingBody& body, SpaceStructure& structure, const std::vector<Removal>& list,
          const SpaceRules& rules, PassReport& report);

/// Matter for the nodes that have none: from neighbours that have more matter than volume, else evenly.
void endow(WorkingBody& body, const SpaceStructure& structure);

} // namespace cnem::adapt
