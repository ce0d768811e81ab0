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

TEST(Pictures, in_space_are_seen_from_an_eye_and_cut_by_planes) {
  const std::string name =
      std::string(CNEM_SOURCE_DIR) + "/cases/three_dimensions/taylor_tetrahedra/case.toml";
  const Case plain = read_case(name);
  EXPECT_EQ(plain.output.picture_fields, (std::vector<std::string>{"plastic_strain", "pressure"}));
  EXPECT_EQ(plain.output.drawing.eye, Vec3(1.0, -1.6, 1.0));
  EXPECT_TRUE(plain.output.sections.empty());
  const Case cut = read_case(name, {"output.drawing.eye=\"0 -1 0\"",
                                    "output.sections.middle={ at = \"0 1 0 mm\", normal = \"0 -2 0\" }"});
  EXPECT_EQ(cut.output.drawing.eye, Vec3(0, -1, 0));
  ASSERT_EQ(cut.output.sections.size(), 1U);
  EXPECT_EQ(cut.output.sections[0].name, "middle");
  EXPECT_EQ(cut.output.sections[0].at, Vec3(0, 1e-3, 0));
  EXPECT_EQ(cut.output.sections[0].normal, Vec3(0, -2, 0));
  try {
    read_case(name, {"output.drawing.eye=\"0 0 0\""});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("output.drawing.eye': found no direction"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace cnem::input
