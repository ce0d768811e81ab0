#include "voronoi/space/order.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cnem::voronoi {

namespace {

constexpr int levels = 20;

/// Distance along the curve of the cell with these coordinates.
std::uint64_t hilbert_distance(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = std::uint32_t{1} << (levels - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& coordinate : x) {
      if (coordinate & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t exchanged = (x[0] ^ coordinate) & below;
        x[0] ^= exchanged;
        coordinate ^= exchanged;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t turned = 0;
  for (std::uint32_t q = std::uint32_t{1} << (levels - 1); q > 1; q >>= 1)
    if (x[2] & q) turned ^= q - 1;
  std::uint64_t distance = 0;
  for (int level = levels - 1; level >= 0; --level)
    for (const std::uint32_t coordinate : x) distance = 2 * distance + (((coordinate ^ turned) >> level) & 1);
  return distance;
}

} // namespace

std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& position) {
  std::vector<std::int32_t> order;
  if (position.empty()) return order;
  Vec3 low = position.front(), high = low;
  for (const Vec3& x : position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double size = (high - low).maxCoeff();
  const double cells = size > 0.0 ? ((1 << levels) - 1) / size : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> key(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec3 cell = (position[i] - low) * cells;
    key[i] = {hilbert_distance({static_cast<std::uint32_t>(cell.x()), static_cast<std::uint32_t>(cell.y()),
                                static_cast<std::uint32_t>(cell.z())}),
              static_cast<std::int32_t>(i)};
  }
  std::sort(key.begin(), key.end());
  for (const auto& [distance, i] : key) order.push_back(i);
  return order;
}

Cloud<3> renumber(const Cloud<3>& cloud, const std::vector<std::int32_t>& order) {
  IndexedVector<NodeIndex, NodeIndex> new_of_old(order.size());
  Cloud<3> result = cloud;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto old = index_of(order[i]);
    new_of_old[old] = as<NodeIndex>(i);
    result.position[i] = cloud.position[old];
  }
  const auto rename = [&](auto& nodes) {
    for (NodeIndex& node : nodes) node = new_of_old[node];
  };
  for (auto& facet : result.facets) rename(facet.node);
  for (auto& pair : result.twins) rename(pair);
  for (auto& corner : result.simplices) rename(corner);
  return result;
}

} // namespace cnem::voronoi
