// Shapes of tools in space from what a case says: where they come to lie.
#include "app/problem/tool_overlap.hpp"
#include "app/problem/tool_solid.hpp"
#include "clouds/tetrahedral_block.hpp"

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

// Overlaps within the tolerance are left to contact, whatever the tool is.
TEST(ToolSolid, may_touch_the_workpiece_and_not_begin_in_it) {
  const Cloud<3> cloud =
      clouds::tetrahedral_block({4, 4, 4}, {4, 4, 4}, [](const Vec3& x) -> Vec3 { return x; }).cloud;
  const auto overlap = [&](const Vec3& low, const Vec3& high) {
    input::ToolSolid solid;
    solid.shape = input::ToolSolid::Shape::box;
    solid.box = {low, high};
    const auto found = app::overlap_at_start(*app::make_solid(solid, cloud), cloud, 0.5);
    return found ? found->depth : 0.0;
  };
  EXPECT_EQ(overlap({-1, -1, 4}, {5, 5, 6}), 0.0) << "touches";
  EXPECT_EQ(overlap({-1, -1, 3.51}, {5, 5, 6}), 0.0) << "within the tolerance";
  EXPECT_NEAR(overlap({-1, -1, 3.4}, {5, 5, 6}), 0.6, 1e-12) << "nodes in the tool";
  EXPECT_EQ(overlap({1.4, 1.4, 3.51}, {1.5, 1.5, 9}), 0.0) << "a pin within the tolerance";
  EXPECT_GT(overlap({1.4, 1.4, 3.2}, {1.5, 1.5, 9}), 0.5) << "a pin between nodes";
  EXPECT_NEAR(overlap({1.4, 1.4, -9}, {1.5, 1.5, 9}), 1.45, 0.2) << "a pin through it";
  EXPECT_NEAR(overlap({2.2, 2.2, 2.2}, {2.8, 2.8, 2.8}), 1.8, 0.25) << "inside";
  input::ToolSolid endless;
  endless.shape = input::ToolSolid::Shape::extruded;
  endless.outline = cnem::testing::box({1.4, 1.4}, {1.5, 1.5});
  EXPECT_TRUE(app::overlap_at_start(*app::make_solid(endless, cloud), cloud, 0.5));
}
