// Cohesive interfaces whose zone of softening is shorter than cells can follow.
#include "app/plausibility/plausibility.hpp"

#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// Two arms 1 mm high, four cells each; E' G/t² is 12.6 cells.
const std::string arms = R"toml(
[time]
end = "1 us"
[domain]
material = "arm"
outer.rectangle = { from = "0 -1 mm", to = "10 1 mm" }
[domain.interfaces.joint]
points = ["0 0 mm", "10 0 mm"]
cohesive = { stiffness = "40 GPa/mm", strength = "60 MPa", energy = "300 J/m2" }
[cloud]
pattern = "regular"
spacing = "0.25 mm"
[materials.arm]
density = "1580 kg/m3"
elastic = { young = "34.28 GPa", poisson = 0.3 }
)toml";
const std::string plies = "materials.arm.elastic={ law = 'orthotropic', E1 = '34.28 GPa', E2 = '11.57 GPa', "
                          "nu12 = 0.24244, G12 = '2.05 GPa' }";

std::vector<std::string> doubts_with(const std::vector<std::string>& overrides) {
  const input::Case input = input::read_case_text(arms, "case.toml", overrides);
  return doubts(input, testing::solver_of(input));
}

TEST(InterfaceDoubts, interfaces_that_soften_over_many_cells_are_sound) {
  EXPECT_EQ(doubts_with({}), std::vector<std::string>{});
  EXPECT_EQ(doubts_with({plies, "cloud.spacing=0.125 mm"}), std::vector<std::string>{});
  EXPECT_EQ(doubts_with({plies, "domain.interfaces.joint.cohesive.strength=40 MPa"}),
            std::vector<std::string>{});
}

TEST(InterfaceDoubts, plies_soft_across_their_fibres_have_a_short_zone) {
  const std::vector<std::string> list = doubts_with({plies, "analysis.kinematics='plane stress'"});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_NE(
      list[0].find("key 'domain.interfaces.joint.cohesive': it softens over E' G/strength² = 0.748 mm "
                   "ahead of a crack, 3 cells of 0.25 mm: below 5.5 a crack sticks and jumps; expected a "
                   "spacing of 0.136 mm at most, or a strength of 44.3 MPa at most, which leaves the "
                   "energy as it is"),
      std::string::npos)
      << list[0];
}

TEST(InterfaceDoubts, a_strong_interface_has_a_short_zone_in_any_matter) {
  EXPECT_EQ(doubts_with({"domain.interfaces.joint.cohesive.strength=90 MPa"}).size(), 0U) << "5.6 cells";
  EXPECT_EQ(doubts_with({"domain.interfaces.joint.cohesive.strength=95 MPa"}).size(), 1U) << "5.01 cells";
}

} // namespace
} // namespace cnem::app
