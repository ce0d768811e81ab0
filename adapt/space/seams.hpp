#pragma once
// Keeps the sides of a slice between periodic planes away from its skin.
#include "adapt/pass_report.hpp"
#include "adapt/space/resample.hpp"

namespace cnem::adapt {

/// Pieces of a period are cuts through matter that goes on a period away, wherever they lie. A tool that
/// drags the skin drags their borders along until the sides lie flat below it, and what is left between them
/// gets as thin as nothing. Where a side comes nearer to the skin than 0.6 of the wanted spacing it is cut
/// anew: of all surfaces of faces of tetrahedra there the least (least_cut.hpp), which stands upright to the
/// skin; nodes less than half of the spacing below the skin add to the weight of their faces. What lies
/// between the old side and the new goes over to the other side (hand_over()). Nodes on two periods, and
/// those that are held, stay; a side that would weigh no less, as not all can go over, or that would cross
/// something, stays as it is. Whether anything went over: the structure has the same tetrahedra then, which
/// need not be those of the cloud's triangulation. O(N) where no side is near the skin; else that of
/// hand_over() and of a minimum cut of the tetrahedra near there. Throws GeometryError as shifted_nodes().
bool recut_sides(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules, PassReport& report);

/// Moves tetrahedra from one side of a period to the other, where they lie on what they lay on before, with
/// the share of the matter of each corner that they have of its tetrahedra. Images move alike: momentum and
/// kinetic energy stay, and so does the volume; a corner whose image was there mixes with it. One after the
/// other, as far as the boundary stays a manifold each time, both sides have the same facets, and no matter
/// comes to another part or body. A corner that was on no side gets an image, one without tetrahedra goes.
/// goes: [tetrahedron]. rules.surface.still has to name the sides; there are no twins. Returns how many went;
/// tetrahedra keep their numbers, and the structure has median cells. O(N log N) for each layer that goes at
/// once. Throws GeometryError as shifted_nodes().
int hand_over(WorkingBody& body, SpaceStructure& structure, const SpaceRules& rules,
              const IndexedVector<SimplexIndex, char>& goes, PassReport& report);

} // namespace cnem::adapt
