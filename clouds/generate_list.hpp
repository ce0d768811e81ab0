#pragma once
// Boundary chains through nodes that a case lists.
#include "clouds/generate_boundary.hpp"

namespace cnem::clouds {

/// Chains along the outline, holes and cracks through those of `nodes` that lie on them; chain vertex i is
/// node i. Expects an oriented domain.
/// Throws GeometryError for nodes that are not finite or coincide and for corners, crack ends and kinks
/// without a node.
BoundaryChains list_boundary(const DomainShape& domain, const std::vector<Vec2>& nodes);

} // namespace cnem::clouds
