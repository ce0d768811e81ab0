#pragma once
// Space-filling order of nodes, so that neighbours in space are neighbours in memory.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// The nodes along a Hilbert curve: order[new] = old. Ties keep their order. O(N log N).
std::vector<std::int32_t> hilbert_order(const std::vector<Vec2>& position);

/// The same cloud with its nodes renumbered: node `new` of the result is node order[new] of `cloud`.
Cloud<2> renumber(const Cloud<2>& cloud, const std::vector<std::int32_t>& order);

} // namespace cnem::voronoi
