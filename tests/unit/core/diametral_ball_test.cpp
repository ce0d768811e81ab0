// The ball that no other node should be in for a facet to be a face of Delaunay tetrahedra.
#include "core/geometry/facets.hpp"

#include <gtest/gtest.h>

namespace cnem {
namespace {

TEST(DiametralBall, has_the_corners_on_it) {
  const std::array<Vec<3>, 3> corner{Vec<3>(1, 0, 0), Vec<3>(0, 2, 0), Vec<3>(0, 0, 1.5)};
  const DiametralBall ball = diametral_ball(corner);
  const Vec<3> normal = area_normal<3>(corner).normalized();
  for (const Vec<3>& x : corner) EXPECT_NEAR((x - ball.centre).norm(), ball.radius, 1e-14);
  EXPECT_NEAR(normal.dot(ball.centre - corner[0]), 0.0, 1e-14) << "the smallest: its centre is on the plane";
}

TEST(DiametralBall, of_a_sliver_is_no_larger_than_its_longest_side) {
  for (const double height : {0.1, 1e-3, 1e-12, 0.0}) {
    const std::array<Vec<3>, 3> corner{Vec<3>(0, 0, 0), Vec<3>(2, 0, 0), Vec<3>(0.9, height, 0)};
    const DiametralBall ball = diametral_ball(corner);
    EXPECT_LE(ball.radius, 2.0) << height;
    for (const Vec<3>& x : corner) EXPECT_LE((x - ball.centre).norm(), ball.radius * (1.0 + 1e-14)) << height;
  }
}

} // namespace
} // namespace cnem
