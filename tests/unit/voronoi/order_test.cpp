#include "voronoi/order.hpp"

#include "tests/unit/voronoi/small_clouds.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace cnem::voronoi::test {
namespace {

TEST(Order, VisitsNeighbouringCellsOneAfterTheOther) {
  std::vector<Vec2> position{{0, 0}, {16, 16}}; // the box of 16 × 16 cells
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) position.emplace_back(x + 0.5, y + 0.5);
  auto order = hilbert_order(position);
  std::erase_if(order, [](std::int32_t i) { return i < 2; });
  ASSERT_EQ(order.size(), 256u);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const Vec2 step =
        position[static_cast<std::size_t>(order[k])] - position[static_cast<std::size_t>(order[k - 1])];
    EXPECT_DOUBLE_EQ(step.norm(), 1.0) << "step " << k;
  }
}

TEST(Order, IsAPermutationAlsoOfCoincidentPoints) {
  auto order = hilbert_order(std::vector<Vec2>(5, Vec2(1, 2)));
  EXPECT_EQ(order, (std::vector<std::int32_t>{0, 1, 2, 3, 4}));
  EXPECT_TRUE(hilbert_order(std::vector<Vec2>{}).empty());
}

TEST(Order, RenumberedCloudIsTheSameDomain) {
  const auto cloud = embedded_crack();
  const auto sorted = renumber(cloud, hilbert_order(cloud.position));
  EXPECT_EQ(triangulate(sorted).triangles(), triangulate(cloud).triangles());
  for (const auto& [a, b] : sorted.twins)
    EXPECT_EQ(sorted.position[static_cast<std::size_t>(a)], sorted.position[static_cast<std::size_t>(b)]);
}

} // namespace
} // namespace cnem::voronoi::test
