// Tools in space as a case says them.
#include "input/case_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::input {
namespace {

Case with_tool(const std::string& tool) {
  return read_case_text(R"([analysis]
kinematics = "three-dimensional"
[time]
end = "10 us"
[domain]
material = "steel"
block = { from = "0 0 0 mm", to = "4 2 2 mm" }
[cloud]
spacing = "1 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[method]
lagrangian = "total"
[tools.punch]
)" + tool,
                        "folder/case.toml");
}

TEST(ToolSolid, punch_with_a_rounded_cutting_edge) {
  const Case c = with_tool(R"(shape = "extruded"
rectangle = { from = "-1 -2 mm", to = "1 2 mm", fillet = "0.5 mm" }
extrude = { from = "0 mm", to = "8 mm", edge_from = "0.1 mm" }
place = { at = "0 0 3 mm", axis = "0 1 0", turn = "90 deg" }
velocity = "0 0 -5 m/s"
)");
  const ToolSolid& solid = *c.tools.at(0).solid;
  EXPECT_EQ(solid.shape, ToolSolid::Shape::extruded);
  EXPECT_EQ(solid.outline.pieces.size(), 8U);
  EXPECT_EQ(solid.low, 0.0);
  EXPECT_EQ(solid.high, 0.008);
  EXPECT_EQ(solid.radius_low, 1e-4);
  EXPECT_EQ(solid.radius_high, 0.0);
  EXPECT_EQ(solid.at, Vec3(0, 0, 0.003));
  EXPECT_EQ(solid.axis, Vec3(0, 1, 0));
  EXPECT_NEAR(solid.turn, 0.5 * std::numbers::pi, 1e-15);
  EXPECT_TRUE(c.tools[0].outline.pieces.empty());
}

TEST(ToolSolid, die_round_an_opening_and_a_body_of_revolution) {
  const Case die = with_tool(R"(shape = "swept"
circle = { centre = "0 0 mm", radius = "5 mm" }
profile = { start = "0 -3 mm", path = [{ to = "4 -3 mm" }, { to = "4 0 mm" }, { to = "0 0 mm", fillet = "0.2 mm" }] }
)");
  EXPECT_EQ(die.tools.at(0).solid->profile.pieces.size(), 5U);
  EXPECT_FALSE(die.tools[0].solid->low.has_value());
  const Case round = with_tool("shape = \"revolved\"\nrectangle = { from = \"0 3 mm\", to = \"1 9 mm\" }\n");
  EXPECT_EQ(round.tools.at(0).solid->outline.pieces.size(), 4U);
}

TEST(ToolSolid, a_half_space_is_what_no_shape_means) {
  const Case c = with_tool("plane = { at = \"0 0 0 mm\", normal = \"0 0 2\" }\n");
  EXPECT_EQ(c.tools.at(0).solid->shape, ToolSolid::Shape::half_space);
  EXPECT_EQ(c.tools[0].solid->plane.normal, Vec3(0, 0, 2));
}

TEST(ToolSolid, moves_as_a_body_along_a_line) {
  const Case c = with_tool(R"(shape = "box"
box = { from = "0 0 5 mm", to = "2 2 3 mm" }
mass = "0.5 kg"
direction = "0 0 -2"
initial_velocity = "0 0 -3 m/s"
force = "0 0 -10 kN"
spring = { stiffness = "1 MN/m" }
)");
  const Tool& tool = c.tools.at(0);
  EXPECT_EQ(tool.solid->box[0], Vec3(0, 0, 0.003));
  EXPECT_EQ(tool.solid->box[1], Vec3(0.002, 0.002, 0.005));
  ASSERT_TRUE(tool.drive && tool.drive->spring);
  EXPECT_EQ(tool.drive->mass, 0.5);
  EXPECT_EQ(tool.drive->free, Mat<3>(Vec3(0, 0, 1).asDiagonal()));
  EXPECT_EQ(tool.drive->spring->along, Vec3(0, 0, -1));
  EXPECT_EQ(tool.drive->force[2](0.0), -1e4);
  EXPECT_EQ(tool.drive->initial_velocity, Vec3(0, 0, -3));
}

} // namespace
} // namespace cnem::input
