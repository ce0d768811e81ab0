#pragma once
// Keeps the sides of a slice between periodic planes away from its skin.
#include "adapt/pass_report.hpp"
#include "adapt/space/resample.hpp"

namespace cnem::adapt {

/// Pieces of a period are cuts through matter that goes on a period away, wherever they lie. A tool that
/// drags the skin drags their borders along until the sides lie flat below it, and what is left between them
/// gets as thin as nothing. Where a side comes nearer to the skin than 0.6 of the wanted spacing it is cut
/// anew: of all surfaces of faces of tetrahedra there the least (least_cut.hpp), which stands upright to the
/// skin. Nodes less than half of the spacing below the skin count up to five times. What lies between the old
/// side and the new goes over to the other side (hand_over()). Nodes on two periods, and those that are held,
/// stay, and where the new surface would cross something all does. Whether anything went over: the structure
/// has the same tetrahedra then, which need not be those of the cloud's triangulation. O(N log N) where a
/// side is near the skin. Throws GeometryError as shifted_nodes().
bool recut_sides(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules, PassReport& report);

/// Moves tetrahedra from one side of a period to the other, where they lie on what they lay on before, with a
/// quarter of their volume of the matter of each corner: images move alike, so that nothing is interpolated,
/// and no volume changes. One after the other, as far as the boundary stays a manifold each time. goes:
/// [tetrahedron]. Returns how many went; they keep their numbers. O(N log N) a layer.
int hand_over(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules,
              const IndexedVector<SimplexIndex, char>& goes);

} // namespace cnem::adapt
