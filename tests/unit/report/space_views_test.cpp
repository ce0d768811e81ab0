// What pictures of a body in space are made of: tools in sections.
#include "clouds/tetrahedral_block.hpp"
#include "input/case_reader.hpp"
#include "report/space_source.hpp"

#include <gtest/gtest.h>

namespace cnem::report {
namespace {

constexpr const char* text = R"(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
block = { from = "0 0 0 m", to = "2 1 1 m" }
[cloud]
spacing = "0.5 m"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[tools.punch]
shape = "box"
box = { from = "-1 -1 1 m", to = "1.5 2 3 m" }
[tools.far]
shape = "box"
box = { from = "0 5 1 m", to = "1 6 3 m" }
[output]
sections.middle = { at = "0 0.5 0 m", normal = "0 -1 0" }
)";

// Where it has moved to, up to the plane of symmetry that the body ends at.
TEST(SpaceViews, sections_have_the_outlines_of_the_tools_that_they_cut) {
  const input::Case input = input::read_case_text(text, "folder/case.toml");
  const clouds::TetrahedralBlock made = clouds::tetrahedral_block({2, 1, 1}, {4, 2, 2});
  SpaceSource source;
  source.tetrahedra = made.tetrahedra;
  resize_all(source.position, made.cloud.position.size());
  for (std::size_t i = 0; i < made.cloud.position.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      source.position[k][i] = made.cloud.position[i][static_cast<Eigen::Index>(k)];
  source.tools = {{0.1, 0, -0.25}, {0, 0, 0}};
  source.sides.push_back({Vec3(0, 0, 0), Vec3(-1, 0, 0)});
  const auto views = space_views(input, source, tool_surfaces(input));
  ASSERT_EQ(views.size(), 2U);
  EXPECT_EQ(views[0]->section, "");
  EXPECT_TRUE(views[0]->tools.empty());
  EXPECT_FALSE(views[0]->solids.corner.empty());
  const SpaceView& view = *views[1];
  EXPECT_EQ(view.section, "middle");
  ASSERT_EQ(view.tools.size(), 1U);
  EXPECT_EQ(view.tools[0].name, "punch");
  Vec2 low(9, 9), high(-9, -9);
  for (const CurvePiece& piece : view.tools[0].curve->pieces) {
    low = low.cwiseMin(piece.from);
    high = high.cwiseMax(piece.from);
  }
  EXPECT_LT((low - Vec2(0, 0.75)).norm(), 1e-12) << low.transpose();
  EXPECT_LT((high - Vec2(1.6, 2.75)).norm(), 1e-12) << high.transpose();
}

} // namespace
} // namespace cnem::report
