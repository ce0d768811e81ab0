// What passes in space leave as a case wants it.
#include "app/forecast/forecast.hpp"
#include "app/space_adaptation.hpp"
#include "app/time_control.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"
#include "tests/steel.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include <string>

namespace cnem::app {
namespace {

input::Case block_with(const std::string& more) {
  return input::read_case_text(R"toml(
[analysis]
kinematics = "three-dimensional"
[time]
end = "1 us"
[domain]
material = "steel"
block = { from = "0 0 0 mm", to = "2 1 1 mm", grid = false }
[method]
rereference = { strain = 0.2 }
[adapt]
resample = true
)toml" + more + testing::steel_304l,
                               "case.toml");
}

const SpaceAdaptation::Follow nothing = [](const Resampling<3>&) {};

TEST(SpaceAdaptation, graded_clouds_stay_graded) {
  const input::Case input = block_with(R"toml(
[cloud]
spacing = "0.25 mm"
refine.corner = { points = ["0 0 0 mm"], spacing = "0.05 mm" }
)toml");
  ExplicitSolver<3> solver = testing::solver_of<3>(input);
  SpaceAdaptation adaptation(input, solver);
  const auto near_corner = [&] {
    const auto& x = solver.state().node.position;
    int count = 0;
    for (std::size_t i = 0; i < x[0].size(); ++i) count += std::hypot(x[0][i], x[1][i], x[2][i]) < 0.5e-3;
    return count;
  };
  const int fine = near_corner();
  ASSERT_GT(fine, 40);
  for (int pass = 0; pass < 3; ++pass) adaptation.renew(solver, nothing);
  EXPECT_NEAR(near_corner(), fine, 0.2 * fine);
}

TEST(SpaceAdaptation, nodes_that_points_of_supports_name_stay) {
  const input::Case input = block_with(R"toml(
[cloud]
spacing = "0.25 mm"
[boundary.pin]
points = ["1 0.5 0.5 mm"]
velocity = "0 0 0 m/s"
[boundary.base]
pieces = ["z-"]
symmetry = true
)toml");
  ExplicitSolver<3> solver = testing::solver_of<3>(input);
  SpaceAdaptation adaptation(input, solver);
  const auto pinned = [&] {
    for (const Support<3>& support : solver.conditions().supports.list())
      if (support.name == "pin") return support.nodes.size();
    return std::size_t{0};
  };
  ASSERT_EQ(pinned(), 1U);
  for (int pass = 0; pass < 2; ++pass) adaptation.renew(solver, nothing);
  EXPECT_EQ(pinned(), 1U);
}

TEST(SpaceAdaptation, an_indicator_refines_surface_and_inside_down_to_h_min) {
  const input::Case input = block_with(R"toml(
[cloud]
spacing = "0.25 mm"
[initial]
velocity = "-200 0 0 m/s"
[tools.wall]
plane = { at = "0 0 0 mm", normal = "1 0 0" }
friction = { law = "none" }
[adapt.indicator]
field = "plastic_strain"
h_min = "0.12 mm"
)toml");
  ExplicitSolver<3> solver = testing::solver_of<3>(input);
  SpaceAdaptation adaptation(input, solver);
  const auto count = [&](double from, double to, bool base) {
    const auto& x = solver.state().node.position;
    int nodes = 0;
    for (std::size_t i = 0; i < x[0].size(); ++i)
      nodes += x[0][i] >= from && x[0][i] < to && (!base || x[0][i] < 1e-6);
    return nodes;
  };
  const auto refined = [&] {
    for (const auto& [name, value] : adaptation.metrics())
      if (name == "adapt.refined") return value;
    return 0.0;
  };
  const int foot = count(-1e-6, 0.4e-3, false), base = count(-1e-6, 0.4e-3, true),
            far = count(1.5e-3, 3e-3, false);
  const double step = solver.stable_step().dt;
  for (int pass = 0; pass < 5; ++pass) {
    for (int n = 0; n < 8; ++n) solver.advance(solver.stable_step().dt);
    adaptation.renew(solver, nothing);
  }
  EXPECT_GT(refined(), 50.0);
  EXPECT_GT(count(-1e-6, 0.4e-3, false), 3 * foot);  // 2.1³ = 9 of a lattice, less on planes and beyond
  EXPECT_GT(count(-1e-6, 0.4e-3, true), 2.5 * base); // 2.1² = 4.3
  EXPECT_LE(count(1.5e-3, 3e-3, false), 1.2 * far);
  EXPECT_GT(solver.stable_step().dt, 0.25 * step); // 1/2.1, and what small tetrahedra take
}

// A box whose edge lies across the top of the block goes along it.
TEST(SpaceAdaptation, tools_have_the_spacing_at_their_edges_that_the_case_asks_for_wherever_they_go) {
  const input::Case input = block_with(R"toml(
tool_spacing = "0.08 mm"
[cloud]
spacing = "0.25 mm"
[tools.box]
shape = "box"
box = { from = "-3 -1 1.001 mm", to = "0.4 2 3 mm" }
velocity = ["5 km/s", "0 m/s", "0 m/s"]
friction = { law = "none" }
)toml");
  ExplicitSolver<3> solver = testing::solver_of<3>(input);
  SpaceAdaptation adaptation(input, solver);
  const auto near_edge = [&](double along) { // nodes on top, of 1 mm of edge
    const auto& x = solver.state().node.position;
    int nodes = 0;
    for (std::size_t i = 0; i < x[0].size(); ++i)
      nodes += std::abs(x[0][i] - along) < 0.13e-3 && x[2][i] > 0.999e-3;
    return nodes;
  };
  const int coarse = near_edge(0.4e-3), nodes = static_cast<int>(solver.state().node.size());
  StepControl control(input.time);
  control.refresh(solver);
  const Forecast expected = forecast(input, solver, control);
  adaptation.fit_to_tools(solver, nothing);
  EXPECT_NEAR(expected.nodes_first / static_cast<double>(solver.state().node.size()), 1.0, 0.15);
  EXPECT_EQ(expected.finest, 0.08e-3);
  const int fine = near_edge(0.4e-3), elsewhere = near_edge(1.6e-3);
  EXPECT_GT(fine, 4 * coarse); // (0.25/0.08)² = 9.8 where it is finest, a third of that at 0.1 mm
  EXPECT_LE(elsewhere, 2 * coarse);
  EXPECT_LT(solver.state().node.size(), 12U * static_cast<std::size_t>(nodes));
  while (solver.state().time < 0.24e-6) solver.advance(solver.stable_step().dt); // 1.2 mm further
  adaptation.fit_to_tools(solver, nothing);
  EXPECT_GT(near_edge(1.6e-3), 0.7 * fine);
  EXPECT_LT(near_edge(0.4e-3), 0.6 * fine); // what lies closer than 0.62 of what is wanted goes
}

} // namespace
} // namespace cnem::app
