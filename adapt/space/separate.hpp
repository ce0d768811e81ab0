#pragma once
// How a body in space parts: a surface of Delaunay facets through broken matter is opened, nothing is
// deleted.
#include "adapt/pass_report.hpp"
#include "adapt/space/structure.hpp"
#include "adapt/space/working_body.hpp"

#include <vector>

namespace cnem::adapt {

struct SeparationRules {
  PieceIndex piece = PieceIndex::none; ///< that new faces belong to
  double gap = 1e-3;                   ///< how far the two faces are set apart, over the wanted spacing
  int least_part = 30;                 ///< nodes of a part that comes off
};

/// The part of each tetrahedron, from 0, once the body is cut between what no broken matter connects: of all
/// surfaces of faces between broken nodes alone the least, with the weight area/broken, mean of its nodes
/// (minimum cut; Boykov and Kolmogorov, IEEE PAMI 26, 2004). What is left of a component keeps one number.
/// Parts of fewer than `least_part` nodes stay with a neighbour, and where the faces would branch in an edge
/// tetrahedra change sides. Empty: nothing parts. broken: [node] as in NodeProperties. O(N log N).
IndexedVector<SimplexIndex, std::int32_t>
parts_between(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh, const Field& broken, int least_part);

/// Opens the faces between parts. A node has a double for each of the connected sets of tetrahedra around it
/// that a part leaves it, and its matter is shared out by their volumes; the doubles are set apart along the
/// normals of the new faces, within the facets they are on. Counts cuts and opened facets. structure: that of
/// the body before.
void separate(WorkingBody& body, const SpaceStructure& structure, const SeparationRules& rules,
              PassReport& report);

} // namespace cnem::adapt
