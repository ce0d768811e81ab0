#pragma once
// A triangulation from an earlier one, far cheaper than from nothing.
#include "voronoi/plane/triangulation.hpp"

#include <optional>

namespace cnem::voronoi {

/// What triangulate() gives, from Cloud::simplices: edges are flipped until all are Delaunay (Lawson),
/// with exact predicates and the ties between cocircular nodes decided as there. Empty where there are none,
/// where they do not fill the domain any more (a triangle has turned over, the boundary touches itself), and
/// with twins. O(N). Throws GeometryError as outgoing_facets() does.
std::optional<Triangulation> retriangulate(const Cloud<2>& cloud);

} // namespace cnem::voronoi
