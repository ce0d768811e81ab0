#pragma once
// Where metal runs out into a sharp edge, its faces stand nearer to each other than nodes do.
#include "adapt/space/working_surface.hpp"
#include "core/fields/aligned.hpp"

namespace cnem::adapt {

/// The spacing (m, [node]) at which nodes of a surface are no nearer to the face behind them than `wanted`
/// (m, [node]): h/sin α, but no more than 4 h, at creases of an acute angle α in the metal, and falling by
/// half of the distance from them along the edges. No more than twice the length of such edges that hang
/// together, less the longest: of a fold it is short, and one edge alone is no crease, or would make itself
/// longer. The stable step is that of cells as thick as the metal there. Nowhere below `wanted`. O(F) a
/// sweep, of which there are as many as edges of a few spacings.
Field spacing_at_sharp_creases(const WorkingSurface& surface, const Field& wanted);

} // namespace cnem::adapt
