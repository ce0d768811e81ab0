// Shapes of tools in space from what a case says: where they come to lie.
#include "app/problem/tool_solid.hpp"

#include "tests/curves.hpp"

#include <gtest/gtest.h>
#include <numbers>

using namespace cnem;

TEST(ToolSolid, is_placed_by_its_axis_and_turn) {
  Cloud<3> cloud;
  cloud.position = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  input::ToolSolid solid;
  solid.shape = input::ToolSolid::Shape::extruded;
  solid.outline = cnem::testing::box({-1, -2}, {1, 2});
  solid.low = 0.0, solid.high = 8.0;
  solid.at = {5, 0, 0};
  solid.axis = {0, 0, -3};
  const auto down = app::make_solid(solid, cloud);
  EXPECT_NEAR(down->closest({5, 0, 0.5}).distance, 0.5, 1e-12);
  EXPECT_NEAR(down->closest({5, 0, -9}).distance, 1.0, 1e-12);
  EXPECT_NEAR(down->closest({7.5, 0, -4}).distance, 1.5, 1e-12);
  solid.turn = 0.5 * std::numbers::pi;
  const auto turned = app::make_solid(solid, cloud);
  EXPECT_NEAR(turned->closest({7.5, 0, -4}).distance, 0.5, 1e-12);
  solid.low.reset(), solid.high.reset();
  const auto endless = app::make_solid(solid, cloud);
  EXPECT_NEAR(endless->closest({7.5, 0, -700}).distance, 0.5, 1e-9);
}
