// Coolants: where they reach, and the heat they take.
#include "app/problem/registry.hpp"
#include "core/index.hpp"
#include "input/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// A hot square on a tool, of so little density of heat that it cools at once, and of one temperature.
constexpr const char* square = R"toml(
[time]
end = "1 us"
[domain]
material = "hot"
outer.rectangle = { from = "0 0 mm", to = "1 1 mm" }
[cloud]
pattern = "regular"
spacing = "0.1 mm"
[materials.hot]
density = "8000 kg/m3"
elastic = { young = "200 GPa", poisson = 0.0 }
heat = { specific_heat = "500 J/(kg K)", conductivity = "4e5 W/(m K)" }
[initial]
temperature = "1000 K"
velocity = "0 -1 m/s"
[boundary.all]
pieces = ["left", "right", "top"]
velocity = "0 -1 m/s"
[tools.anvil]
rectangle = { from = "-1 -1 mm", to = "2 0 mm" }
[tools.slide]
rectangle = { from = "-1 2 mm", to = "2 3 mm" }
velocity = "100 0 m/s"
[coolants.jet]
coefficient = "1e7 W/(m2 K)"
temperature = "300 K"
)toml";

ExplicitSolver<2> hot_square(const std::vector<std::string>& overrides = {}) {
  Setup<2> setup = build<2>(input::read_case_text(square, "square.toml", overrides));
  return {std::move(setup.problem), std::move(setup.velocity), std::move(setup.temperature)};
}

/// The length of boundary, m, that cools a square of one temperature as fast as it cooled until 1 µs.
double cooled_length(ExplicitSolver<2> solver) {
  while (solver.state().time < 1e-6)
    solver.advance(std::min(solver.stable_step().dt, 1e-6 - solver.state().time));
  const EnergyLedger ledger = solver.ledger();
  EXPECT_LE(std::abs(ledger.heat_residual()), 1e-12 * std::abs(ledger["heat_content"]));
  const double capacity = 8000.0 * 500.0 * 1e-6, left = 1.0 + ledger["heat_content"] / (capacity * 700.0);
  return -std::log(left) * capacity / (1e7 * 1e-6);
}

TEST(Coolant, reaches_all_of_the_boundary_that_touches_nothing) {
  EXPECT_NEAR(cooled_length(hot_square()), 3e-3, 0.05 * 3e-3)
      << "three sides, and not the fourth on the tool";
}

TEST(Coolant, reaches_what_is_in_its_box) {
  EXPECT_NEAR(cooled_length(hot_square({"coolants.jet.box=[\"-1 0.45 mm\", \"0.5 2 mm\"]"})), 1.05e-3,
              0.05e-3)
      << "half of the left side, and half of the upper one";
}

TEST(Coolant, goes_with_a_tool) {
  const char* ahead = "coolants.jet.box=[\"-0.55 0.45 mm\", \"-0.05 2 mm\"]"; // ends 0.05 mm beyond the edge
  EXPECT_LT(cooled_length(hot_square({ahead})), 1e-6);
  EXPECT_GT(cooled_length(hot_square({ahead, "coolants.jet.follow=\"slide\""})), 2.5e-4);
}

/// A node that a resampled boundary has got is cooled as those beside it.
TEST(Coolant, follows_the_boundary_of_a_changed_cloud) {
  Cloud<2> cloud;
  cloud.position = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto side = [](int a, int b, int piece) {
    return Facet<2>{{as<NodeIndex>(a), as<NodeIndex>(b)}, as<PieceIndex>(piece)};
  };
  cloud.facets = {side(0, 1, 0), side(1, 2, 0), side(2, 3, 0), side(3, 0, 0)};
  ThermalBoundaries<2> boundaries;
  boundaries.cool({Coolant<2>{{"jet", TimeTable(10.0), TimeTable(300.0)}, {}, ToolIndex::none}}, cloud);
  cloud.facets[as<CloudFacetIndex>(0)] = side(0, 4, 0);
  cloud.facets.push_back(side(4, 1, 1)); // a piece that was not there
  cloud.position.push_back({0.5, 0});
  boundaries.resample(cloud);
  Fields<2> position;
  for (const Vec2& x : cloud.position)
    for (std::size_t k = 0; k < 2; ++k) position[k].push_back(x[static_cast<int>(k)]);
  Field flow(5, 0.0);
  boundaries.add_coolant_flow(0.0, {}, position, Field(5, 400.0), flow);
  for (const auto& [node, expected] :
       {std::pair<std::size_t, double>{0, -750.0}, {1, -750.0}, {2, -1000.0}, {3, -1000.0}, {4, -500.0}})
    EXPECT_NEAR(flow[node], expected, 1e-9) << node;
}

} // namespace
} // namespace cnem::app
