#include "voronoi/order.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <limits>

namespace cnem::voronoi {

namespace {

/// Distance along the Hilbert curve of the given number of levels at cell (x, y). Without branches: they are
/// as good as random.
std::uint64_t hilbert_distance(std::uint32_t x, std::uint32_t y, int levels) {
  std::uint64_t distance = 0;
  for (std::uint32_t s = std::uint32_t{1} << (levels - 1); s > 0; s >>= 1) {
    const std::uint32_t right = (x & s) != 0, upper = (y & s) != 0;
    distance = 4 * distance + ((3 * right) ^ upper);
    const std::uint32_t turned = right & ~upper & 1, swapped = upper ^ 1;
    x ^= -turned;
    y ^= -turned;
    const std::uint32_t exchanged = (x ^ y) & -swapped;
    x ^= exchanged;
    y ^= exchanged;
  }
  return distance;
}

} // namespace

std::vector<std::int32_t> hilbert_order(const std::vector<Vec2>& position) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Vec2& x : position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  constexpr int levels = 24;
  const double size = position.empty() ? 0.0 : (high - low).maxCoeff();
  const double cells = size > 0.0 ? ((1 << levels) - 1) / size : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> key(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec2 cell = (position[i] - low) * cells;
    key[i] = {
        hilbert_distance(static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y()), levels),
        static_cast<std::int32_t>(i)};
  }
  std::sort(key.begin(), key.end());
  std::vector<std::int32_t> order(position.size());
  for (std::size_t i = 0; i < key.size(); ++i) order[i] = key[i].second;
  return order;
}

Cloud<2> renumber(const Cloud<2>& cloud, const std::vector<std::int32_t>& order) {
  IndexedVector<NodeIndex, NodeIndex> new_of_old(order.size());
  Cloud<2> result = cloud;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto old = index_of(order[i]);
    new_of_old[old] = as<NodeIndex>(i);
    result.position[i] = cloud.position[old];
  }
  const auto rename = [&](NodeIndex& node) { node = new_of_old[node]; };
  for (auto& facet : result.facets)
    for (auto& node : facet.node) rename(node);
  for (auto& pair : result.twins)
    for (auto& node : pair) rename(node);
  for (auto& corner : result.simplices)
    for (auto& node : corner) rename(node);
  return result;
}

} // namespace cnem::voronoi
