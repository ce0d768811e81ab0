// Metal that is warmed under the pressure of a cut expands against it: the stored energy is fed by heat, and
// the balance of mechanical energy holds that.
#include "tests/finished_run.hpp"
#include "tests/shared_cases.hpp"

namespace cnem::testing {
namespace {

const std::string warm_cut = aluminium_cut + R"toml(
[materials.aluminium.heat]
specific_heat = "900 J/(kg K)"
conductivity = "120 W/(m K)"
[cloud]
spacing = "0.12 mm"
[adapt]
tool_spacing = "15 um"
surface_spacing = "0.03 mm"
indicator = { h_min = "0.03 mm", h_max = "0.06 mm" }
[output]
pictures = []
)toml";

/// Energy that heat gave over the work of the tool.
double given(const std::vector<std::string>& more) {
  const FinishedRun run = finish(input::read_case_text(warm_cut, "case.toml", more));
  EXPECT_LT(std::abs(run.status.energy_residual), 2e-4);
  return run.of("energy.thermal_expansion").back() / run.of("energy.tool_work").back();
}

TEST(ThermalExpansion, FeedsTheStoredEnergy) {
  EXPECT_GT(given({"materials.aluminium.heat.expansion=2.3e-5 1/K"}), 2e-3);
}

TEST(ThermalExpansion, OfAnEquationOfStateDoesSoToo) {
  EXPECT_GT(
      given({"materials.aluminium.equation_of_state={ law = \"mie-gruneisen\", S1 = 1.338, gamma0 = 2.0 }"}),
      2e-3);
}

TEST(ThermalExpansion, IsNoEntryWithoutOne) {
  const FinishedRun run = finish(input::read_case_text(warm_cut, "case.toml", {"time.max_steps=5"}));
  EXPECT_EQ(run.history.find("energy.thermal_expansion"), -1);
}

} // namespace
} // namespace cnem::testing
