#pragma once
// Space-filling order of nodes, so that neighbours in space are neighbours in memory.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// The nodes along a Hilbert curve: order[new] = old. Ties keep their order. O(N log N).
std::vector<std::int32_t> hilbert_order(const std::vector<Vec2>& position);
std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& position);

/// The same cloud with its nodes renumbered: node `new` of the result is node order[new] of `cloud`.
template<int dim> Cloud<dim> renumber(const Cloud<dim>& cloud, const std::vector<std::int32_t>& order);
extern template Cloud<2> renumber(const Cloud<2>&, const std::vector<std::int32_t>&);
extern template Cloud<3> renumber(const Cloud<3>&, const std::vector<std::int32_t>&);

} // namespace cnem::voronoi
