// The order of nodes in space is a Hilbert curve: on a lattice of a power of two each node is beside the
// last.
#include "voronoi/order.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace cnem::voronoi {
namespace {

TEST(SpaceOrder, goes_from_neighbour_to_neighbour) {
  std::vector<Vec3> position;
  for (int i = 0; i < 512; ++i) position.push_back(Vec3(i % 8, i / 8 % 8, i / 64));
  const std::vector<std::int32_t> order = hilbert_order(position);
  ASSERT_EQ(order.size(), position.size());
  std::vector<char> seen(position.size(), 0);
  for (const std::int32_t i : order) seen[index_of(i)] = 1;
  for (std::size_t n = 1; n < order.size(); ++n)
    EXPECT_EQ((position[index_of(order[n])] - position[index_of(order[n - 1])]).norm(), 1.0) << n;
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 512);
}

TEST(SpaceOrder, renumbers_what_names_nodes) {
  Cloud<3> cloud;
  for (int i = 0; i < 4; ++i) cloud.position.push_back(Vec3(i == 1, i == 2, i == 3));
  const auto node = [](int i) { return as<NodeIndex>(i); };
  cloud.facets = {{{node(0), node(2), node(1)}, {}}};
  cloud.twins = {{node(1), node(3)}};
  const Cloud<3> other = renumber(cloud, {3, 2, 1, 0});
  for (int i = 0; i < 4; ++i) EXPECT_EQ(other.position[node(3 - i)], cloud.position[node(i)]);
  EXPECT_EQ(other.facets[index_of(0)].node, (std::array{node(3), node(1), node(2)}));
  EXPECT_EQ(other.twins[0], (std::array{node(2), node(0)}));
}

} // namespace
} // namespace cnem::voronoi
