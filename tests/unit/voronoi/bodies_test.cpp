// Bodies that press on each other overlap: each is triangulated for itself, as if it were alone.
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/bodies.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/recovery.hpp"
#include "voronoi/space/triangulate.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace cnem::voronoi {
namespace {

double volume_of(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  double sum = 0.0;
  for (const auto& node : mesh.node)
    sum += measure<3>(
        {cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]], cloud.position[node[3]]});
  return sum;
}

TEST(Bodies, that_overlap_are_triangulated_each_for_itself) {
  const Cloud<3> together = testing::pressed_cubes(4, 0.03, false),
                 cloud = testing::pressed_cubes(4, 0.03, true);
  EXPECT_FALSE(crossings(together).empty());
  EXPECT_THROW(triangulate(together), GeometryError);
  EXPECT_TRUE(crossings(cloud).empty());
  const RecoveredBoundary recovered = recover_boundary(cloud);
  const Tetrahedra& mesh = recovered.tetrahedra;
  EXPECT_NEAR(volume_of(recovered.cloud, mesh), 2.0, 1e-12);
  EXPECT_TRUE(std::is_sorted(mesh.node.begin(), mesh.node.end()));
  EXPECT_EQ(triangulate(recovered.cloud).node, mesh.node);
  EXPECT_EQ(bodies_of(mesh), recovered.cloud.body);
  // who is whose neighbour, and on which facets they lie, is as for tetrahedra from anywhere
  const Tetrahedra again = connected(recovered.cloud, {mesh.node.begin(), mesh.node.end()});
  EXPECT_EQ(again.neighbour, mesh.neighbour);
  EXPECT_EQ(again.facet, mesh.facet);
  EXPECT_EQ(again.of_node, mesh.of_node);
}

TEST(Bodies, are_what_they_are_alone) {
  const Cloud<3> cloud = testing::pressed_cubes(4, 0.03, true);
  const std::vector<SingleBody> bodies = single_bodies(cloud);
  ASSERT_EQ(bodies.size(), 2);
  const RecoveredBoundary both = recover_boundary(cloud);
  std::size_t tetrahedra = 0;
  for (const SingleBody& body : bodies) {
    EXPECT_EQ(body.cloud.facets.size(), cloud.facets.size() / 2);
    const RecoveredBoundary alone = recover_boundary(body.cloud);
    tetrahedra += alone.tetrahedra.node.size();
    EXPECT_TRUE(bodies_of(alone.tetrahedra).empty());
    for (const auto& node : alone.tetrahedra.node) {
      std::array<NodeIndex, 4> there{};
      for (std::size_t k = 0; k < 4; ++k) there[k] = both.now[body.node[node[k]]];
      EXPECT_TRUE(std::binary_search(both.tetrahedra.node.begin(), both.tetrahedra.node.end(), there));
    }
  }
  EXPECT_EQ(both.tetrahedra.node.size(), tetrahedra);
}

} // namespace
} // namespace cnem::voronoi
