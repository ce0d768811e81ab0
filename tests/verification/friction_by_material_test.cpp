// Friction of a tool that differs between the materials of a workpiece.
#include "tests/finished_run.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>

namespace cnem::testing {
namespace {

using Texts = std::vector<std::string>;

// A plate slides on a block of two halves of like elasticity, which it presses together.
const std::string rubbed = R"toml(
[time]
end = "3 us"
[analysis]
thermal = false
[domain]
material = "one"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
interfaces.joint.points = ["2 0 mm", "2 2 mm"]
regions.right = { at = "3 1 mm", material = "other" }
[cloud]
pattern = "regular"
spacing = "0.25 mm"
[materials.one]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.0 }
[materials.other]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.0 }
[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[tools.plate]
rectangle = { from = "-6 2 mm", to = "6 4 mm" }
velocity = "100 -5 m/s"
friction = { law = "coulomb", coefficient = 0.1 }
[output]
history_every = "0.1 us"
)toml";

FinishedRun rub(const Texts& overrides) {
  return finish(input::read_case_text(rubbed, "case.toml", overrides));
}

TEST(FrictionByMaterial, named_for_all_it_is_that_of_all) {
  const FinishedRun same = rub({"tools.plate.friction.coefficient=0.3"});
  const FinishedRun named = rub({"tools.plate.friction.by_material.one.coefficient=0.3",
                                 "tools.plate.friction.by_material.other.coefficient=0.3"});
  EXPECT_EQ(named.of("plate.force_x"), same.of("plate.force_x"));
  EXPECT_EQ(named.of("energy.friction"), same.of("energy.friction"));
  const double ratio = same.of("plate.force_x").back() / same.of("plate.force_y").back();
  EXPECT_NEAR(std::abs(ratio), 0.3, 1e-9); // all nodes slip
}

// A plate that lies on one half alone, and slides on it.
TEST(FrictionByMaterial, each_half_rubs_with_its_own) {
  const std::string other = "tools.plate.friction.by_material.other.coefficient=0.3";
  for (const auto& [plate, expected] :
       {std::pair(R"(tools.plate.rectangle={from="-6 2 mm",to="1.2 4 mm"})", 0.1),
        std::pair(R"(tools.plate.rectangle={from="2.3 2 mm",to="9 4 mm"})", 0.3)}) {
    const FinishedRun done = rub({other, plate});
    const FinishedRun same = rub({fmt::format("tools.plate.friction.coefficient={}", expected), plate});
    EXPECT_EQ(done.of("plate.force_x"), same.of("plate.force_x"));
    EXPECT_GT(std::abs(done.of("plate.force_x").back()), 0.0);
    EXPECT_LT(done.status.energy_residual, 1e-3);
  }
}

} // namespace
} // namespace cnem::testing
