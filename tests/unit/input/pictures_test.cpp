// Which fields pictures show where the case does not say.
#include "tests/unit/input/case_text.hpp"

#include "tests/shared_cases.hpp"

namespace cnem::input {
namespace {

using Names = std::vector<std::string>;

TEST(Pictures, show_what_the_analysis_computes) {
  const std::string heat = "heat = { specific_heat = \"460 J/(kg K)\", conductivity = \"50 W/(m K)\" }\n";
  EXPECT_EQ(read_small().output.picture_fields, (Names{"plastic_strain", "pressure"}));
  EXPECT_EQ(read_small(heat).output.picture_fields, (Names{"plastic_strain", "temperature", "pressure"}));
  EXPECT_EQ(read_small(heat, {"analysis.mechanical=false", "analysis.thermal=true"}).output.picture_fields,
            Names{"temperature"});
  EXPECT_EQ(read_case_text(testing::pulled_block, "case.toml").output.picture_fields,
            (Names{"equivalent_stress", "displacement_x", "displacement_y"}));
  EXPECT_EQ(read_small("", {"output.picture_fields=[\"pressure\"]"}).output.picture_fields,
            Names{"pressure"});
}

TEST(Pictures, are_of_the_plane) {
  const Case space =
      read_case(std::string(CNEM_SOURCE_DIR) + "/cases/three_dimensions/taylor_tetrahedra/case.toml");
  EXPECT_TRUE(space.output.picture_fields.empty());
}

} // namespace
} // namespace cnem::input
