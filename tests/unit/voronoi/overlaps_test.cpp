// What new triangles take of old ones: known fractions, walls, domains that have folded.
#include "voronoi/plane/overlaps.hpp"

#include "core/error.hpp"
#include "tests/clouds.hpp"
#include "tests/unit/voronoi/small_clouds.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <gtest/gtest.h>

namespace cnem::voronoi {
namespace {

using namespace testing::literals;

using Triangles = std::vector<Simplex<2>>;
using Positions = IndexedVector<NodeIndex, Vec2>;

const Triangles along{{0_node, 1_node, 2_node}, {0_node, 2_node, 3_node}};
const Triangles across{{0_node, 1_node, 3_node}, {1_node, 2_node, 3_node}};

TEST(Overlaps, of_a_flipped_square_are_halves) {
  const Positions square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto rows = overlaps(square, along, across);
  EXPECT_EQ(rows.begin, (std::vector<std::int32_t>{0, 2, 4}));
  EXPECT_EQ(rows.from,
            (std::vector<SimplexIndex>{SimplexIndex{0}, SimplexIndex{1}, SimplexIndex{0}, SimplexIndex{1}}));
  for (const double weight : rows.weight) EXPECT_DOUBLE_EQ(weight, 0.5);
}

// The halves of a square away from the axis turn to rings whose volumes are as the radii of their centroids.
TEST(Overlaps, of_revolution_are_those_of_rings) {
  const Positions square{{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  const auto rows = overlaps(square, along, across, Space::revolution);
  // of the old triangle below the diagonal, centroid at 5/3: its left part is (1,0) (2,0) (1.5,0.5) at 1.5
  ASSERT_EQ(rows.weight.size(), 4U);
  EXPECT_NEAR(rows.weight[0], 0.5 * 1.5 / (5.0 / 3.0), 1e-15);
  EXPECT_NEAR(rows.weight[2], 1.0 - 0.5 * 1.5 / (5.0 / 3.0), 1e-15);
}

TEST(Overlaps, corners_may_stand_in_any_order) {
  const Positions square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto rows = overlaps(square, along, Triangles{{2_node, 1_node, 0_node}, {3_node, 0_node, 2_node}});
  EXPECT_EQ(rows.begin, (std::vector<std::int32_t>{0, 1, 2}));
  for (const double weight : rows.weight) EXPECT_EQ(weight, 1.0);
}

TEST(Overlaps, of_a_domain_that_has_folded_is_refused) {
  const Positions folded{{0, 0}, {1, 0}, {0.3, 0.3}, {0, 1}}; // node 2 has come over the other diagonal
  EXPECT_THROW(overlaps(folded, along, across), GeometryError);
}

/// Two squares on either side of a wall, whose faces have their own nodes.
Cloud<2> walled() {
  Cloud<2> cloud;
  testing::add_loop(cloud, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.1);
  testing::add_loop(cloud, {{1, 0}, {2, 0}, {2, 1}, {1, 1}}, 0.1);
  testing::declare_twins(cloud);
  testing::fill(cloud, testing::Lattice::square, 0.1, 0.25, 0.05, 3);
  return cloud;
}

TEST(Overlaps, nothing_passes_a_wall) {
  Cloud<2> cloud = walled();
  const auto old = triangulate(cloud);
  const auto side = [&](const Simplex<2>& triangle) {
    Vec2 sum(0, 0);
    for (const NodeIndex i : triangle) sum += cloud.position[i];
    return sum.x() > 3.0;
  };
  std::vector<bool> old_side, side_of;
  for (const auto& triangle : old.node) old_side.push_back(side(triangle));
  const Cloud<2> before = cloud;
  for (Vec2& x : cloud.position) x.x() += 0.6 * x.y();
  const auto now = triangulate(cloud);
  const auto rows = overlaps(cloud.position, old.node, now.node);
  cloud = before;
  std::size_t mixed = 0;
  for (std::size_t t = 0; t < rows.size(); ++t) {
    mixed += rows.mixed(t);
    for (auto e = index_of(rows.begin[t]); e < index_of(rows.begin[t + 1]); ++e)
      EXPECT_EQ(old_side[index_of(rows.from[e])], side(now.node[t])) << "triangle " << t;
  }
  EXPECT_GT(mixed, 50U);
}

} // namespace
} // namespace cnem::voronoi
