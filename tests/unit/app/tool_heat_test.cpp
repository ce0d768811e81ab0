// Tools that conduct: the flow through a contact, energy, coatings, held faces, friction.
#include "core/index.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// A column that is pressed on a tool; it does not widen, and conducts so well that heat runs as far as
/// waves do.
constexpr const char* column = R"toml(
[time]
end = "8 us"
[domain]
material = "hot"
outer.rectangle = { from = "0 0 mm", to = "0.1 1 mm" }
[cloud]
pattern = "regular"
spacing = "20 um"
[materials.hot]
density = "8000 kg/m3"
elastic = { young = "200 GPa", poisson = 0.0 }
heat = { specific_heat = "500 J/(kg K)", conductivity = "4000 W/(m K)" }
[initial]
temperature = "1000 K"
velocity = "0 -1 m/s"
[boundary.top]
pieces = ["top"]
velocity = "0 -1 m/s"
[tools.anvil]
rectangle = { from = "0 -1 mm", to = "0.1 0 mm", names.bottom = "foot" }
[tools.anvil.heat]
temperature = "300 K"
conductance = "3e7 W/(m2 K)"
conductivity = "8000 W/(m K)"
density = "8000 kg/m3"
specific_heat = "1000 J/(kg K)"
section.spacing = "20 um"
)toml";

ExplicitSolver<2> start(const std::vector<std::string>& overrides) {
  return testing::solver_of(input::read_case_text(column, "column.toml", overrides));
}

void advance(ExplicitSolver<2>& solver, double end) {
  while (solver.state().time < end)
    solver.advance(std::min(solver.stable_step().dt, end - solver.state().time));
}

/// Mean temperature of the section's nodes at a height, m.
double tool_temperature(const ExplicitSolver<2>& solver, double y) {
  const ToolSection<2>& section = solver.model().tool_sections.front();
  double sum = 0.0;
  int count = 0;
  for (const NodeIndex i : section.cloud.position.indices())
    if (std::abs(section.cloud.position[i].y() - y) < 1e-9)
      sum += solver.state().tool_temperature.front()[index_of(i)], ++count;
  return sum / count;
}

double bottom_temperature(const ExplicitSolver<2>& solver) {
  const NodeState<2>& node = solver.state().node;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < node.size(); ++i)
    if (node.initial_position[1][i] < 1e-9) sum += node.temperature[i], ++count;
  return sum / count;
}

double most_taken(const EnergyLedger& ledger) {
  return std::max({std::abs(ledger["heat_content"]), std::abs(ledger["tool_heat_content"]),
                   std::abs(ledger["tool_heat_exchanged"])});
}

/// Two half-spaces of effusivities e, E with a conductance h between them from t = 0 on (Carslaw and Jaeger
/// 1959): the faces are at T1 − ΔT E/(e + E) s, T2 + ΔT e/(e + E) s, s = 1 − exp(g²t) erfc(g √t),
/// g = h (1/e + 1/E).
TEST(ToolHeat, passes_a_conductance_as_half_spaces_do) {
  ExplicitSolver<2> solver = start({});
  const double e = std::sqrt(4000.0 * 8000.0 * 500.0), E = std::sqrt(8000.0 * 8000.0 * 1000.0);
  for (const double t : {2e-6, 5e-6, 8e-6}) {
    advance(solver, t);
    const double gt = 3e7 * (1.0 / e + 1.0 / E) * std::sqrt(t), s = 1.0 - std::exp(gt * gt) * std::erfc(gt);
    EXPECT_NEAR(bottom_temperature(solver), 1000.0 - 700.0 * E / (e + E) * s, 0.01 * 700.0) << t;
    EXPECT_NEAR(tool_temperature(solver, 0.0), 300.0 + 700.0 * e / (e + E) * s, 0.01 * 700.0) << t;
  }
}

TEST(ToolHeat, keeps_all_heat) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{},
        {"tools.anvil.heat.section.held=[\"foot\"]"},
        {"tools.anvil.velocity=\"200 0 m/s\"", "tools.anvil.friction.law=\"coulomb\"",
         "tools.anvil.friction.coefficient=0.3", "tools.anvil.rectangle.to=\"2 0 mm\"",
         "tools.anvil.rectangle.from=\"-2 -0.5 mm\"", "boundary.top.velocity=\"0 -1 m/s\""},
        {"tools.anvil.heat.section.coating={thickness=\"2 um\", conductivity=\"20 W/(m K)\", density=\"5000 "
         "kg/m3\", specific_heat=\"600 J/(kg K)\"}"}}) {
    ExplicitSolver<2> solver = start(more);
    advance(solver, 4e-6);
    const EnergyLedger ledger = solver.ledger();
    EXPECT_LT(std::abs(ledger.heat_residual()), 1e-12 * most_taken(ledger));
    EXPECT_GT(ledger["tool_heat_content"], 0.0);
    EXPECT_EQ(ledger["heat_exchanged"], 0.0) << "nothing leaves tool and workpiece but through held nodes";
  }
}

TEST(ToolHeat, takes_its_share_of_the_friction) {
  const auto generated = [](const char* share) {
    ExplicitSolver<2> solver =
        start({"tools.anvil.velocity=\"200 0 m/s\"", "tools.anvil.friction.law=\"coulomb\"",
               "tools.anvil.friction.coefficient=0.3", "tools.anvil.rectangle.to=\"2 0 mm\"",
               "tools.anvil.rectangle.from=\"-2 -0.5 mm\"", "tools.anvil.heat.conductance=\"0 W/(m2 K)\"",
               std::string("tools.anvil.heat.friction_share=") + share});
    advance(solver, 2e-6);
    const EnergyLedger ledger = solver.ledger();
    EXPECT_NEAR(ledger["tool_heat_generated"] + ledger["heat_generated"], ledger["friction"],
                1e-12 * ledger["friction"]);
    EXPECT_NEAR(ledger["tool_heat_content"], ledger["tool_heat_generated"], 1e-12 * ledger["friction"]);
    return ledger["tool_heat_generated"] / ledger["friction"];
  };
  EXPECT_NEAR(generated("0.25"), 0.25, 1e-12);
  EXPECT_NEAR(generated("1.0"), 1.0, 1e-12);
}

TEST(ToolHeat, holds_what_is_held) {
  ExplicitSolver<2> solver =
      start({"tools.anvil.heat.section.held=[\"foot\"]", "tools.anvil.rectangle.from=\"0 -0.2 mm\""});
  advance(solver, 6e-6);
  EXPECT_EQ(tool_temperature(solver, -2e-4), 300.0);
  EXPECT_GT(tool_temperature(solver, 0.0), 350.0);
  EXPECT_LT(solver.ledger()["tool_heat_exchanged"], 0.0);
}

/// Under a steady flow a coating is a resistance t/k more; by the same heat a tool of a tenth of the capacity
/// warms ten times as much.
TEST(ToolHeat, coatings_insulate_and_capacities_scale) {
  const auto content = [](std::vector<std::string> overrides) { // so wide that its ends hardly count
    overrides.insert(overrides.end(),
                     {"domain.outer.rectangle.to=\"0.8 1 mm\"", "tools.anvil.rectangle.from=\"-0.2 -1 mm\"",
                      "tools.anvil.rectangle.to=\"1 0 mm\""});
    ExplicitSolver<2> solver = start(overrides);
    advance(solver, 5e-6);
    return solver.ledger()["tool_heat_content"];
  };
  const char* coating = "tools.anvil.heat.section.coating={thickness=\"20 um\", conductivity=\"20 W/(m K)\", "
                        "density=\"100 kg/m3\", specific_heat=\"60 J/(kg K)\"}";
  const char* conductance = "tools.anvil.heat.conductance=\"9.67741935e5 W/(m2 K)\""; // 1/(1/3e7 + 20e-6/20)
  const double coated = content({coating}), resisting = content({conductance}), plain = content({});
  EXPECT_NEAR(coated, resisting, 0.05 * resisting);
  EXPECT_LT(coated, 0.3 * plain);

  ExplicitSolver<2> light = start({"tools.anvil.heat.section.heat_capacity_factor=0.1"}), heavy = start({});
  const auto sum = [](const ExplicitSolver<2>& solver) {
    double total = 0.0;
    for (const double c : solver.model().tool_sections.front().heat_capacity) total += c;
    return total;
  };
  EXPECT_NEAR(sum(heavy), 8000.0 * 1000.0 * 1e-7, 1e-9);
  EXPECT_NEAR(sum(light), 0.1 * sum(heavy), 1e-12);
}

TEST(ToolHeat, finds_the_nearest_place_on_its_faces) {
  const ExplicitSolver<2> solver = start({});
  const ToolSection<2>& section = solver.model().tool_sections.front();
  const FacePlace<2> place = section.nearest_on_faces({4.5e-5, 1e-6});
  Vec2 x = Vec2::Zero();
  for (std::size_t a = 0; a < 2; ++a) x += place.weight[a] * section.cloud.position[place.node[a]];
  EXPECT_LT((x - Vec2(4.5e-5, 0.0)).norm(), 1e-15);
}

} // namespace
} // namespace cnem::app
