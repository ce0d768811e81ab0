#pragma once
// Whether a boundary is beyond doubt that of a domain, by exact predicates.
#include "core/geometry/cloud.hpp"

namespace cnem::voronoi {

/// The loops of facets of each body neither touch nor cross themselves or each other, and have the domain on
/// their left.
/// False also where it would take more to tell. O(facets log facets) where facets are about as long as each
/// other.
bool is_plain_boundary(const Cloud<2>& cloud);

} // namespace cnem::voronoi
