// Doubts about bodies in space.
#include "app/plausibility/plausibility.hpp"

#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

using Texts = std::vector<std::string>;

/// A punch goes into the end of a bar; its edge is round.
const std::string sound_extrusion = R"toml(
[analysis]
kinematics = "three-dimensional"
thermal = false
[time]
end = "20 us"
[let]
edge = "1.1 mm"
[cloud]
spacing = "0.5 mm"
[domain]
material = "aluminium"
block = { shape = "cylinder", part = "quarter", radius = "5 mm", length = "4 mm" }
[materials.aluminium]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "linear", yield = "80 MPa", hardening = "40 MPa" }
[boundary.held]
pieces = ["x-", "y-", "bottom"]
symmetry = true
[tools.punch]
shape = "revolved"
start = "0 4 mm"
path = [{ to = "3.5 4 mm", fillet = "edge" }, { to = "3.5 12 mm" }, { to = "0 12 mm" }]
velocity = { z = { value = "-25 m/s", ramp = "10 us", smooth = true } }
)toml";

Texts doubts_in_space(const Texts& changes) {
  const input::Case input = input::read_case_text(sound_extrusion, "case.toml", changes);
  return doubts(input, testing::solver_of<3>(input));
}

TEST(PlausibilityInSpace, arcs_that_no_node_feels) {
  EXPECT_EQ(doubts_in_space({}), Texts{});
  const Texts list = doubts_in_space({"let.edge=0.6 mm"});
  ASSERT_EQ(list.size(), 1);
  EXPECT_NE(list.front().find("key 'tools.punch': its arc of 0.6 mm is 1.2 spacings"), std::string::npos)
      << list.front();
  EXPECT_EQ(doubts_in_space({"let.edge=0.6 mm", "adapt.resample=true", "adapt.tool_spacing=0.25 mm"}),
            Texts{});
}

TEST(PlausibilityInSpace, arcs_far_from_the_workpiece_are_not_doubted) {
  EXPECT_EQ(doubts_in_space({"let.edge=0.6 mm", "tools.punch.start=0 7 mm", "tools.punch.path[0].to=3.5 7 mm",
                             "time.end=2 ms"}),
            Texts{});
}

TEST(PlausibilityInSpace, supports_that_prescribe_different_motions) {
  const Texts pulled{"boundary.held.pieces=[\"x-\", \"y-\"]", "boundary.foot.pieces=[\"bottom\"]",
                     "boundary.foot.velocity.z=1 m/s", "boundary.wall.pieces=[\"side\"]"};
  const auto with = [&](const std::string& speed) {
    Texts changes = pulled;
    changes.push_back("boundary.wall.velocity.z=" + speed);
    return doubts_in_space(changes);
  };
  EXPECT_EQ(with("1 m/s"), Texts{});
  const Texts list = with("-1 m/s");
  ASSERT_EQ(list.size(), 1);
  EXPECT_NE(list.front().find("key 'boundary.wall': prescribes another motion along (0, 0, 1) than "
                              "boundary.foot of 21 nodes that both hold, such as the one at ("),
            std::string::npos)
      << list.front();
}

} // namespace
} // namespace cnem::app
