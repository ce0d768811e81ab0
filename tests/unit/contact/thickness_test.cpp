// How thick tools are, and what goes through them.
#include "contact/thickness.hpp"

#include "contact/plane_shape.hpp"
#include "tests/curves.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace cnem::contact {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Vec2 turned(double angle, const Vec2& x) { return Eigen::Rotation2Dd(angle) * x; }

/// 4 by 0.1, turned about the origin.
Thickness plate(double angle) {
  std::vector<Vec2> corners{{-2, 0}, {2, 0}, {2, 0.1}, {-2, 0.1}};
  for (Vec2& corner : corners) corner = turned(angle, corner);
  return Thickness(testing::polygon(corners));
}

TEST(Thickness, of_a_plate_is_seen_along_the_way) {
  for (const double angle : {0.0, 0.3, 0.8, 2.0, -1.0}) {
    const Thickness slanted = plate(angle);
    EXPECT_NEAR(slanted.least(), 0.1, 1e-12);
    EXPECT_NEAR(slanted.along(turned(angle, {0, 1})), 0.1, 1e-8);
    EXPECT_NEAR(slanted.along(turned(angle, {0, -1})), 0.1, 1e-8);
    EXPECT_NEAR(slanted.along(turned(angle, {0.6, 0.8})), 0.125, 1e-8);
    EXPECT_NEAR(slanted.along(turned(angle, {1, 0})), 4.0, 1e-8);
  }
}

TEST(Thickness, is_that_of_the_thinnest_leg) {
  const Thickness hook(
      testing::polygon({{0, 0}, {3, 0}, {3, 0.1}, {0.5, 0.1}, {0.5, 2}, {0, 2}})); // an L of two plates
  EXPECT_NEAR(hook.least(), 0.1, 1e-12);
  EXPECT_NEAR(hook.along({0, 1}), 0.1, 1e-8);
  EXPECT_NEAR(hook.along({1, 0}), 0.5, 1e-8);
  EXPECT_NEAR(hook.passed({2, -1}, {2, 1}), 0.1, 1e-12);
  EXPECT_NEAR(hook.passed({-1, 1}, {1, 1}), 0.5, 1e-12);
  EXPECT_NEAR(hook.passed({2, 1}, {-1, 1}), 0.5, 1e-12);
}

TEST(Thickness, of_round_tools_counts_where_faces_look_away) {
  Curve roll;
  roll.pieces.push_back({{1, 0}, {1, 0}, {0, 0}, 1.0, false, ""});
  const Thickness round(roll);
  EXPECT_GT(round.least(), 0.1);
  EXPECT_NEAR(round.passed({-2, 0.01}, {2, 0.01}), 2.0, 0.03);
  EXPECT_EQ(round.passed({-2, 0.95}, {2, 0.95}), 0.0) << "grazing";
  EXPECT_NEAR(round.along(Vec2(1, 1).normalized()), 1.85, 0.15) << "of those up to 33° off the middle";
}

TEST(Thickness, corners_may_be_cut) {
  const Thickness block(testing::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(block.passed({0.9, -0.05}, {1.05, 0.1}), 0.0);
  EXPECT_EQ(block.passed({0.9, -0.05}, {0.95, 0.1}), 0.0) << "it has not left: contact sees it";
  EXPECT_NEAR(block.passed({0.9, -0.05}, {0.9, 1.05}), 1.0, 1e-12);
  EXPECT_NEAR(block.passed({0.8, 0.1}, {0.8, 1.05}), 0.9, 1e-12) << "from where it had sunk in";
  EXPECT_EQ(block.passed({0.8, 0.1}, {0.8, -0.05}), 0.0) << "back the way it came";
  EXPECT_EQ(block.passed({2, 0}, {2, 1}), 0.0);
}

TEST(Thickness, of_a_half_space_has_no_end) {
  const PlaneShape<2> wall({0, 0}, {0, 1}, 1.0);
  EXPECT_EQ(wall.least_thickness(), infinite);
  EXPECT_EQ(wall.thickness_along({0, 1}), infinite);
  EXPECT_EQ(wall.passed({0, 1}, {0, -1}), 0.0);
}

} // namespace
} // namespace cnem::contact
