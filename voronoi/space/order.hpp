#pragma once
// Space-filling order of nodes in space, as voronoi/order.hpp in the plane.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// The nodes along a Hilbert curve (Skilling 2004): order[new] = old. Ties keep their order. O(N log N).
std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& position);

/// The same cloud with its nodes renumbered: node `new` of the result is node order[new] of `cloud`.
Cloud<3> renumber(const Cloud<3>& cloud, const std::vector<std::int32_t>& order);

} // namespace cnem::voronoi
