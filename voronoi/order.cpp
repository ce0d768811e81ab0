#include "voronoi/order.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
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

/// The same for cell (x, y, z) of space (Skilling, Programming the Hilbert curve, 2004).
std::uint64_t hilbert_distance(std::array<std::uint32_t, 3> x, int levels) {
  for (std::uint32_t q = std::uint32_t{1} << (levels - 1); q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t swapped = (x[0] ^ x[k]) & below;
      if (x[k] & q) {
        x[0] ^= below;
      } else {
        x[0] ^= swapped;
        x[k] ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t gray = 0;
  for (std::uint32_t q = std::uint32_t{1} << (levels - 1); q > 1; q >>= 1)
    if (x[2] & q) gray ^= q - 1;
  for (std::uint32_t& component : x) component ^= gray;
  std::uint64_t distance = 0;
  for (int bit = levels - 1; bit >= 0; --bit)
    for (const std::uint32_t component : x) distance = 2 * distance + ((component >> bit) & 1);
  return distance;
}

template<int dim, class Distance>
std::vector<std::int32_t> order_along(const std::vector<Vec<dim>>& position, int levels,
                                      const Distance& distance) {
  Vec<dim> low = Vec<dim>::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Vec<dim>& x : position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double size = position.empty() ? 0.0 : (high - low).maxCoeff();
  const double cells = size > 0.0 ? ((1 << levels) - 1) / size : 0.0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> key(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    std::array<std::uint32_t, dim> cell;
    for (int k = 0; k < dim; ++k)
      cell[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>((position[i] - low)[k] * cells);
    key[i] = {distance(cell), static_cast<std::int32_t>(i)};
  }
  std::sort(key.begin(), key.end());
  std::vector<std::int32_t> order(position.size());
  for (std::size_t i = 0; i < key.size(); ++i) order[i] = key[i].second;
  return order;
}

} // namespace

std::vector<std::int32_t> hilbert_order(const std::vector<Vec2>& position) {
  constexpr int levels = 24;
  return order_along<2>(position, levels, [](const std::array<std::uint32_t, 2>& cell) {
    return hilbert_distance(cell[0], cell[1], levels);
  });
}

std::vector<std::int32_t> hilbert_order(const std::vector<Vec3>& position) {
  constexpr int levels = 20;
  return order_along<3>(position, levels, [](const std::array<std::uint32_t, 3>& cell) {
    return hilbert_distance(cell, levels);
  });
}

template<int dim> Cloud<dim> renumber(const Cloud<dim>& cloud, const std::vector<std::int32_t>& order) {
  IndexedVector<NodeIndex, NodeIndex> new_of_old(order.size());
  Cloud<dim> result = cloud;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto old = index_of(order[i]);
    new_of_old[old] = as<NodeIndex>(i);
    result.position[i] = cloud.position[old];
  }
  for (std::size_t i = 0; i < cloud.body.size(); ++i) result.body[i] = cloud.body[index_of(order[i])];
  const auto rename = [&](NodeIndex& node) { node = new_of_old[node]; };
  for (auto& facet : result.facets)
    for (auto& node : facet.node) rename(node);
  for (auto& pair : result.twins)
    for (auto& node : pair) rename(node);
  for (auto& corner : result.simplices)
    for (auto& node : corner) rename(node);
  return result;
}

template Cloud<2> renumber(const Cloud<2>&, const std::vector<std::int32_t>&);
template Cloud<3> renumber(const Cloud<3>&, const std::vector<std::int32_t>&);

} // namespace cnem::voronoi
