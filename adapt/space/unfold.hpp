#pragma once
// Takes folds out of a surface in space before it is resampled.
#include "adapt/pass_report.hpp"
#include "adapt/space/periods.hpp"
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"

namespace cnem::adapt {

/// Moves nodes of facets that cross each other (voronoi::crossings) until none does, at most half of the
/// wanted spacing. Where those that look at each other are within each other by a hundredth of it at most, as
/// contact leaves them, they part by little more than that, in 12 rounds. Where no images have to go alike
/// nodes go, one after the other, by the step towards their neighbours or along their normal after which
/// their facets cross over the least length, in 24 rounds. Else, in 36 rounds: towards the mean of their
/// neighbours on the surface, which takes ridges down that have fallen over, and where two faces have run
/// into each other back through the other one. Which way that is the winding number says: above both faces it
/// is -1 where matter has been between them, 0 where a gap has. Nodes stay on the planes that boundaries have
/// there. Before that, pieces that rules.still names give way, which are cuts through matter that goes on a
/// period away: where one of them crosses a face the nodes within it go behind the face, with their images,
/// which changes no volume, and those of the face stay. They go as far as it takes, out of planes too, by 0.3
/// of the wanted spacing at most in each of 12 rounds; where that does not help they are set back. What
/// unfolding encloses more or less is given back by nodes around that do not lie on another face, to a
/// hundredth if they can, as give_back() does, in 24 rounds; where 0.2% of the body are left all nodes go
/// back. Counts the nodes that unfolding moves as folded. held: [node] those that stay; size: [node] m,
/// wanted spacing; images: nodes that continue each other a period away, which move alike. O(F log² F) for
/// each of the rounds, and O(F) for each node that is tried. Throws GeometryError as voronoi::surface_edges()
/// does.
void unfold(Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held, const Field& size,
            const PeriodImages& images, const SurfaceRules& rules, PassReport& report);

} // namespace cnem::adapt
