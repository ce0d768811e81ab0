#pragma once
// What contact has left of overlaps: nodes that stand in the facets of another body, or of a fragment.
#include "core/fields/state.hpp"
#include "core/geometry/cloud.hpp"

namespace cnem {

/// Sets nodes of the boundary apart from facets that face them and under which they lie by less than a
/// thousandth of the facet, where two bodies overlap (winding number 2 or more, so that no film is turned
/// inside out). A node that a tool and two facets hold is left so by contact, and the smallest crossing is
/// none that a cloud can be made of. position: m, of the nodes of the cloud.
void part_boundary(const Cloud<2>& cloud, Fields<2>& position);

} // namespace cnem
