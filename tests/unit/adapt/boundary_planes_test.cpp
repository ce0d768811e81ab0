// What of a way leaves nodes on the planes of their boundary.
#include "adapt/space/boundary_planes.hpp"
#include "core/geometry/facets.hpp"
#include "tests/space_clouds.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace cnem::adapt {
namespace {

const Vec3 way(1.0, 2.0, 3.0);

Vec3 within(const std::vector<Vec3>& normals) { return within_planes(normals, way); }

TEST(WithinPlanes, keep_planes_lines_and_points) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), oblique = Vec3(1, 1, 0).normalized();
  EXPECT_EQ(within({}), way);
  EXPECT_EQ(within({x}), Vec3(0, 2, 3));
  EXPECT_EQ(within({x, -x}), Vec3(0, 2, 3)); // the faces of a slit
  EXPECT_LT((within({x, Vec3(1, 1e-8, 0).normalized()}) - Vec3(0, 2, 3)).norm(), 1e-12);
  EXPECT_LT((within({x, y}) - Vec3(0, 0, 3)).norm(), 1e-15);
  EXPECT_LT((within({x, y, oblique}) - Vec3(0, 0, 3)).norm(), 1e-15); // through one line
  EXPECT_EQ(within({x, y, z}), Vec3(0, 0, 0));
}

TEST(BoundaryPlanes, of_a_cube_are_its_faces_and_of_a_ball_none) {
  const Cloud<3> cube = testing::unrecovered({.shape = testing::SpaceShape::cube, .cells = 4});
  const BoundaryPlanes planes(cube);
  for (const auto& facet : cube.facets)
    for (const NodeIndex i : facet.node) {
      const Vec3& x = cube.position[i];
      for (Eigen::Index k = 0; k < 3; ++k) {
        const bool on_face = x[k] == 0.0 || x[k] == 1.0;
        EXPECT_NEAR(planes.keep(i, way)[k], on_face ? 0.0 : way[k], 1e-12);
      }
    }
  const Cloud<3> shell =
      testing::unrecovered({.shape = testing::SpaceShape::shell, .cells = 6, .jitter = 0.2});
  const BoundaryPlanes none(shell);
  for (const auto& facet : shell.facets) EXPECT_EQ(none.keep(facet.node[0], way), way);
}

TEST(BoundaryPlanes, of_pieces_are_those_that_are_plane_as_a_whole) {
  Cloud<3> cube = testing::unrecovered({.shape = testing::SpaceShape::cube, .cells = 4});
  PieceIndex top = PieceIndex::none;
  for (const auto& facet : cube.facets) {
    const auto x = corners_of<3>(facet, cube.position);
    if (x[0].z() == 1.0 && x[1].z() == 1.0 && x[2].z() == 1.0) top = facet.piece;
  }
  for (Vec3& x : cube.position) // a step along a line of nodes: both sides of it are plane
    if (x.z() == 1.0) x.z() += 0.1 * std::max(0.0, x.x() - 0.5);
  const BoundaryPlanes beside(cube), whole(cube, Plane::piece);
  for (const auto& facet : cube.facets) {
    if (facet.piece != top) continue;
    for (const NodeIndex i : facet.node) {
      const Vec3& x = cube.position[i];
      if (x.x() == 0.0 || x.x() == 1.0 || x.y() == 0.0 || x.y() == 1.0) continue;
      EXPECT_EQ(whole.keep(i, way), way);
      EXPECT_NE(beside.keep(i, way), way);
    }
  }
}

} // namespace
} // namespace cnem::adapt
