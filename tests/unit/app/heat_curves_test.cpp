// Specific heat and conductivity over temperature: steady profiles, and heat that stays.
#include "app/problem/registry.hpp"
#include "core/index.hpp"
#include "input/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// A rod that conducts between ends of two temperatures; its conductivity is tripled on the way.
constexpr const char* rod = R"toml(
[analysis]
mechanical = false
[time]
end = "1 s"
[domain]
material = "metal"
outer.rectangle = { from = "0 0 mm", to = "2 0.4 mm" }
[cloud]
pattern = "regular"
spacing = "0.1 mm"
[materials.metal]
density = "8000 kg/m3"
elastic = { young = "200 GPa", poisson = 0.3 }
[materials.metal.heat]
specific_heat = "500 J/(kg K)"
conductivity = "20 W/(m K)"
factors_at = "300 600 900 K"
specific_heat_factors = [1.0, 1.5, 1.3]
conductivity_factors = [1.0, 1.4, 3.0]
[initial]
temperature = "300 K"
[boundary.cold]
pieces = ["left"]
temperature = "300 K"
[boundary.hot]
pieces = ["right"]
temperature = "900 K"
)toml";

ExplicitSolver<2> conducting_rod(const std::vector<std::string>& overrides = {}) {
  Setup<2> setup = build<2>(input::read_case_text(rod, "rod.toml", overrides));
  return {std::move(setup.problem), std::move(setup.velocity), std::move(setup.temperature)};
}

void conduct(ExplicitSolver<2>& solver, double end) {
  while (solver.state().time < end)
    solver.advance(std::min(solver.stable_step().dt, end - solver.state().time));
}

double heat_error(const ExplicitSolver<2>& solver) {
  const EnergyLedger ledger = solver.ledger();
  return std::abs(ledger.heat_residual()) /
         std::max(std::abs(ledger["heat_content"]), std::abs(ledger["heat_exchanged"]));
}

/// ∫ k dT from 300 K over 20 W/(m K).
double rod_potential(double temperature) {
  const double t = temperature - 300.0;
  return t < 300.0 ? t + 0.5 * 0.4 / 300.0 * t * t
                   : 360.0 + 1.4 * (t - 300.0) + 0.5 * 1.6 / 300.0 * (t - 300.0) * (t - 300.0);
}

TEST(HeatOverTemperature, steady_profile_is_that_of_kirchhoff) {
  ExplicitSolver<2> solver = conducting_rod();
  conduct(solver, 3.0);
  const NodeState<2>& node = solver.state().node;
  for (std::size_t i = 0; i < node.size(); ++i)
    EXPECT_NEAR(rod_potential(node.temperature[i]), rod_potential(900.0) * node.position[0][i] / 2e-3, 1e-6)
        << node.position[0][i];
  EXPECT_LT(heat_error(solver), 1e-10);
}

/// What conducts keeps an address of the operators.
TEST(HeatOverTemperature, a_solver_that_is_moved_goes_on_as_one_that_is_not) {
  ExplicitSolver<2> stays = conducting_rod(), first = conducting_rod();
  conduct(stays, 0.1);
  conduct(first, 0.1);
  ExplicitSolver<2> moved = std::move(first);
  conduct(stays, 0.2);
  conduct(moved, 0.2);
  EXPECT_EQ(moved.state().node.temperature, stays.state().node.temperature);
}

/// The heat that came in is q t, and all of it is found at its temperature.
TEST(HeatOverTemperature, heat_that_enters_is_held) {
  ExplicitSolver<2> solver = conducting_rod({"boundary={left={pieces=[\"left\"], heat_flux=\"2 MW/m2\"}}"});
  conduct(solver, 1.0);
  EXPECT_NEAR(solver.ledger()["heat_content"], 2e6 * 4e-4 * 1.0, 1e-9 * 800.0);
  EXPECT_LT(heat_error(solver), 1e-12);
  double mean = 0.0;
  for (const double t : solver.state().node.temperature)
    mean += t / static_cast<double>(solver.state().node.size());
  EXPECT_NEAR(mean, 300.0 + 800.0 / (8000.0 * 500.0 * 8e-7) / 1.19, 15.0)
      << "a factor of 1.19 on the way to 510 K";
}

TEST(HeatOverTemperature, bonded_metals_share_heat_without_loss) {
  const char* other = "materials.other={heat={specific_heat=\"900 J/(kg K)\", "
                      "conductivity=\"100 W/(m K)\", factors_at=\"300 500 K\", specific_heat_factors=[1.0, "
                      "0.5]}, density=\"2700 kg/m3\", elastic={young=\"70 GPa\", poisson=0.3}}";
  ExplicitSolver<2> solver =
      conducting_rod({other, "domain.interfaces.joint.points=[\"1 0 mm\", \"1 0.4 mm\"]",
                      "domain.regions.right={at=\"1.5 0.2 mm\", material=\"other\", temperature=\"700 K\"}",
                      "boundary={left={pieces=[\"left\"], heat_flux=\"0 W/m2\"}}"});
  conduct(solver, 0.05);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_NEAR(ledger["heat_exchanged"], 0.0, 1e-12);
  double moved = 0.0;
  const NodeState<2>& node = solver.state().node;
  for (std::size_t i = 0; i < node.size(); ++i)
    moved += 0.5 * node.heat_capacity[i] * std::abs(node.temperature[i] - node.initial_temperature[i]);
  EXPECT_GT(moved, 50.0);
  EXPECT_NEAR(ledger["heat_content"], 0.0, 1e-11 * moved);
}

TEST(HeatOverTemperature, tools_conduct_by_it_and_lose_nothing) {
  ExplicitSolver<2> solver = conducting_rod(
      {"analysis.mechanical=true", "boundary={top={pieces=[\"top\"], velocity=\"0 -1 m/s\"}}",
       "initial={temperature=\"900 K\", velocity=\"0 -1 m/s\"}",
       "tools.anvil={rectangle={from=\"0 -0.4 mm\", to=\"2 0 mm\", names.bottom=\"foot\"}, "
       "heat={temperature=\"300 K\", conductance=\"1e8 W/(m2 K)\", conductivity=\"4000 W/(m K)\", "
       "density=\"8000 kg/m3\", specific_heat=\"500 J/(kg K)\", factors_at=\"300 400 K\", "
       "conductivity_factors=[1.0, 0.2], specific_heat_factors=[1.0, 2.0], "
       "section={spacing=\"0.1 mm\", held=[\"foot\"]}}}"});
  conduct(solver, 1e-6);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_GT(ledger["tool_heat_content"], 0.0);
  EXPECT_LT(std::abs(ledger.heat_residual()), 1e-12 * std::abs(ledger["heat_content"]));
  const ToolSection<2>& section = solver.model().tool_sections.front();
  EXPECT_DOUBLE_EQ(section.heat_curves.quickest, 1.0);
  double content = 0.0;
  for (std::size_t i = 0; i < section.nodes(); ++i)
    content += section.heat_capacity[i] *
               (section.heat_curves.enthalpy(solver.state().tool_temperature[0][i]) - 300.0);
  EXPECT_NEAR(ledger["tool_heat_content"], content, 1e-12 * content);
}

} // namespace
} // namespace cnem::app
