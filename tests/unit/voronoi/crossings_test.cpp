// What crosses and touches is found, what shares corners, edges or a slit is not.
#include "core/geometry/facets.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>

namespace cnem::voronoi {
namespace {

using testing::SpaceShape;

TEST(Crossings, are_none_of_valid_bodies) {
  for (const SpaceShape shape : testing::space_shapes)
    for (const double jitter : {0.0, 0.3})
      for (const bool turned : {false, true})
        EXPECT_TRUE(
            crossings(testing::unrecovered({.shape = shape, .cells = 6, .jitter = jitter, .turned = turned}))
                .empty())
            << name_of(shape);
}

/// The node nearest to a place.
NodeIndex nearest(const Cloud<3>& cloud, const Vec3& x) {
  NodeIndex best{};
  for (const NodeIndex i : cloud.position.indices())
    if ((cloud.position[i] - x).norm() < (cloud.position[best] - x).norm()) best = i;
  return best;
}

TEST(Crossings, are_found_where_a_node_passes_through_the_other_side) {
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::thin_wall, .cells = 6});
  const NodeIndex node = nearest(cloud, {0.5, 0.5, 0.0});
  cloud.position[node].z() = 0.99 / 6;
  EXPECT_TRUE(crossings(cloud).empty());
  cloud.position[node].z() = 1.0 / 6; // on a node of the other side
  EXPECT_FALSE(crossings(cloud).empty());
  cloud.position[node].z() = 1.01 / 6;
  const auto pairs = crossings(cloud);
  ASSERT_FALSE(pairs.empty());
  for (const auto& [f, g] : pairs) {
    EXPECT_LT(f, g);
    const auto has = [&](CloudFacetIndex facet) {
      const auto& corner = cloud.facets[facet].node;
      return std::find(corner.begin(), corner.end(), node) != corner.end();
    };
    EXPECT_NE(has(f), has(g)); // its facets cross those of the other side
  }
}

TEST(Crossings, are_found_where_a_facet_folds_on_to_its_neighbour) {
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 4});
  const NodeIndex node = nearest(cloud, {0.5, 0.5, 0.0});
  cloud.position[node] = Vec3(0.9, 0.6, 0.0); // within the same face, past its neighbours
  EXPECT_FALSE(crossings(cloud).empty());
  cloud.position[node] = Vec3(0.25, 0.5, 0.0);
  EXPECT_FALSE(crossings(cloud).empty()); // facets without area
}

TEST(Crossings, of_suspects_are_those_that_have_one) {
  testing::Random random(3);
  int found = 0;
  for (const SpaceShape shape : {SpaceShape::cube, SpaceShape::torus, SpaceShape::slit}) {
    const Cloud<3> sound = testing::unrecovered({.shape = shape, .cells = 6, .jitter = 0.2});
    for (int n = 0; n < 20; ++n) {
      Cloud<3> cloud = sound;
      std::vector<char> moved(cloud.position.size(), 0);
      for (int k = 0; k < 3; ++k) {
        const NodeIndex i = cloud.facets[static_cast<std::size_t>(random.uniform(0.0, 1.0) * 100.0)].node[0];
        for (Eigen::Index axis = 0; axis < 3; ++axis) cloud.position[i][axis] += random.uniform(-0.4, 0.4);
        moved[index_of(i)] = 1;
      }
      std::vector<CloudFacetIndex> suspects;
      for (const CloudFacetIndex f : cloud.facets.indices()) {
        const auto& node = cloud.facets[f].node;
        if (moved[index_of(node[0])] || moved[index_of(node[1])] || moved[index_of(node[2])])
          suspects.push_back(f);
      }
      const auto all = crossings(cloud);
      EXPECT_EQ(crossings(cloud, suspects), all) << name_of(shape);
      found += static_cast<int>(all.size());
    }
  }
  EXPECT_GT(found, 100);
}

} // namespace
} // namespace cnem::voronoi
