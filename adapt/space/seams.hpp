#pragma once
// Keeps the sides of a slice between periodic planes upright to its skin.
#include "adapt/space/periods.hpp"
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"

namespace cnem::adapt {

/// Pieces of a period are cuts through matter that goes on a period away, wherever they lie. A tool that
/// drags the skin drags their borders along until the sides lie flat below it, and what is left between them
/// gets as thin as nothing. Where skin and side stand at less than 12° to each other on one image the border
/// goes over what is thin, along an edge of the skin, by 0.3 of the wanted spacing at most and by two fifths
/// of that edge, and nodes within the side beside it go away from the skin until they are 0.4 of the spacing
/// below it, by 0.2 at once; images go alike, which changes no volume where the skin is plane. What would
/// cross something is put back. Borders in which pieces of the skin meet go along these alone, nodes on two
/// periods stay. Returns the number of nodes that move. held: [node] those that stay; size: [node] m, wanted
/// spacing; images: across periods, whose pieces rules.still names. O(F log² F) where anything moves. Throws
/// GeometryError as shifted_nodes() does.
int straighten_seams(Cloud<3>& cloud, const PeriodImages& images, const IndexedVector<NodeIndex, char>& held,
                     const Field& size, const SurfaceRules& rules);

} // namespace cnem::adapt
