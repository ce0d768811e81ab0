// A step that viscosity has made too long is looked at anew at once, whenever the next look is due.
#include "app/time_control.hpp"
#include "input/case_reader.hpp"
#include "mechanics/stable_step.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"
#include "tests/unit/app/command_line_fixture.hpp"

#include <gtest/gtest.h>
#include <sstream>

namespace cnem::app {
namespace {

/// An elastic strip of 4 um between nodes 0.1 mm apart, pressed together through its thickness.
constexpr const char* strip = R"toml(
[time]
end = "50 ns"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "2 0.004 mm" }
[cloud]
spacing = "0.1 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[initial]
velocity_gradient.yy = "-1e7 1/s"
[output]
pictures = []
)toml";

/// Pressed together at a rate at which quadratic viscosity is half of the critical damping of a cell.
const std::string pressed = testing::free_block + R"toml(
[time]
end = "0.1 us"
step.check_every = 1000
[initial]
velocity_gradient.xx = "-1e7 1/s"
[output]
history_every = "0 s"
fields_every = "0.1 us"
pictures = []
)toml";

TEST(DampedStep, a_step_is_outgrown_by_damping_until_it_is_looked_at_anew) {
  const input::Case input = input::read_case_text(pressed, "case.toml");
  ExplicitSolver<2> solver = testing::solver_of(input);
  StepControl control(input.time);
  control.refresh(solver);
  EXPECT_FALSE(control.outgrown(solver));
  const double first = control.limit();
  solver.advance(first);
  const double damping = solver.critical_damping();
  EXPECT_GT(damping, 0.4);
  EXPECT_TRUE(control.outgrown(solver));
  control.refresh(solver);
  EXPECT_FALSE(control.outgrown(solver));
  EXPECT_NEAR(control.limit() / first, damped_step(damping), 0.05); // cells have become a little smaller
}

TEST(DampedStep, shares_of_the_step_and_of_damping_are_inverse) {
  for (const double damping : {0.0, 0.06, 0.5, 2.0})
    EXPECT_NEAR(damping_of_step(damped_step(damping)), damping, 1e-15);
}

using DampedRun = CommandLine;

TEST_F(DampedRun, the_second_step_is_as_short_as_damping_asks) {
  const std::filesystem::path file = folder / "pressed.toml";
  std::ofstream(file) << pressed;
  ASSERT_EQ(call({"run", file.string(), "--output", results(), "--force"}), 0) << message;
  std::ifstream history(folder / "results" / "history.csv");
  std::vector<double> steps;
  for (std::string line; std::getline(history, line);) {
    std::istringstream row(line);
    std::string cell;
    for (int column = 0; column < 3; ++column) std::getline(row, cell, ',');
    if (steps.empty() && cell == "dt[s]") continue;
    steps.push_back(std::stod(cell));
  }
  ASSERT_GT(steps.size(), 3u);
  EXPECT_LT(steps[2], 0.8 * steps[1]); // [0] is the start
}

// As if they were as long as wide they would be damped by several times what the step is made for: 2.6% of
// the work at the lower rate, and the run would diverge at the other.
TEST_F(DampedRun, flat_cells_are_damped_no_more_than_others) {
  const std::filesystem::path file = folder / "strip.toml";
  std::ofstream(file) << strip;
  for (const auto& [rate, most] : {std::pair("-3e6 1/s", 0.01), std::pair("-1e7 1/s", 0.03)}) {
    ASSERT_EQ(call({"run", file.string(), "--output", results(), "--force", "--set",
                    std::string("initial.velocity_gradient.yy=") + rate}),
              0)
        << message;
    EXPECT_LT(std::abs(results::read_status(results()).energy_residual), most) << rate;
  }
}

} // namespace
} // namespace cnem::app
