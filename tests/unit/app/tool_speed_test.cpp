// Tools that are too fast for their contact to be seen, and how a user learns of it.
#include "app/tool_speed.hpp"

#include "app/command_line.hpp"
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::app {
namespace {

/// Dilatational waves: 6001 m/s, the first step about 4e-8 s.
const std::string block = R"toml(
[time]
end = "2 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.4 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[boundary.base]
pieces = ["bottom"]
symmetry = true
)toml";

input::Case read(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return input::read_case_text(block + more, "case.toml", overrides);
}

std::string punch(const std::string& velocity) {
  return "[tools.punch]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 4.1 mm\" }\nvelocity = " + velocity +
         "\n";
}

std::vector<std::string> warnings_of(const input::Case& input) {
  std::vector<std::string> none;
  return supersonic_tools(input, make_solver<2>(input, none));
}

TEST(ToolSpeed, width_is_seen_along_the_way) {
  Curve bar; // 4 by 1, turned by 45°
  const double s = std::numbers::sqrt2 / 2.0;
  const Vec2 along(s, s), across(-s, s);
  const std::vector<Vec2> corners{{0, 0}, 4.0 * along, 4.0 * along + across, across};
  for (std::size_t k = 0; k < 4; ++k)
    bar.pieces.push_back({corners[k], corners[(k + 1) % 4], {0, 0}, 0.0, false, ""});
  EXPECT_NEAR(width_along(bar, along), 4.0, 1e-12);
  EXPECT_NEAR(width_along(bar, -across), 1.0, 1e-12);
  Curve roll;
  roll.pieces.push_back({{1, 0}, {1, 0}, {0, 0}, 1.0, false, ""});
  EXPECT_NEAR(width_along(roll, along), 2.0, 0.01);
}

TEST(ToolSpeed, of_sound_is_a_warning) {
  EXPECT_TRUE(warnings_of(read(punch("\"0 -5900 m/s\""))).empty());
  const auto fast = warnings_of(read(punch("\"0 -6100 m/s\"")));
  ASSERT_EQ(fast.size(), 1U);
  EXPECT_NE(
      fast[0].find("tools.punch and the workpiece meet at 6100 m/s, faster than sound in 'steel' (6001 m/s)"),
      std::string::npos)
      << fast[0];
  EXPECT_EQ(
      warnings_of(read(punch("{ times = \"0 1 2 us\", values = [\"0 0 m/s\", \"0 -7 km/s\", \"0 0 m/s\"] }")))
          .size(),
      1U)
      << "in the middle of the run";
  EXPECT_TRUE(
      warnings_of(read(punch("{ times = \"0 3 4 us\", values = [\"0 0 m/s\", \"0 0 m/s\", \"0 -7 km/s\"] }")))
          .empty())
      << "after its end";
  EXPECT_EQ(warnings_of(read(punch("\"0 -4 km/s\"") + "[initial]\nvelocity = \"0 3 km/s\"\n")).size(), 1U)
      << "towards each other";
  EXPECT_EQ(warnings_of(read(punch("\"0 -70 m/s\""), {"time.mass_scaling.factor=1e4"})).size(), 1U)
      << "scaled masses slow the waves";
}

TEST(ToolSpeed, of_more_than_its_width_a_step_is_refused) {
  const std::string foil =
      "[tools.punch]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 2.2 mm\" }\nvelocity = \"0 -1 km/s\"\n";
  const input::Case input = read(foil);
  std::vector<std::string> none;
  const ExplicitSolver<2> solver = make_solver<2>(input, none);
  EXPECT_NO_THROW(check_tool_steps(input, solver, 0.99e-7));
  EXPECT_NO_THROW(check_moving_tools(input, solver, 0.99e-7));
  EXPECT_THROW(check_tool_steps(input, solver, 1.01e-7), InputError);
  EXPECT_NO_THROW(check_tool_steps(read(foil, {"time.end=90 ns"}), solver, 1.0))
      << "no step is longer than a run";
  EXPECT_THROW(check_moving_tools(input, solver, 1.01e-7), DivergenceError);
}

TEST(ToolSpeed, that_a_force_brings_ends_the_run) {
  const cnem::testing::TemporaryFolder folder("tool_speed");
  const std::string file = (folder.path() / "case.toml").string(),
                    results = (folder.path() / "results").string();
  std::ofstream(file)
      << block
      << "[tools.foil]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 2.11 mm\" }\nmass = \"0.1 kg/m\"\n"
         "direction = \"0 1\"\nforce = \"0 100 MN/m\"\n[output]\npictures = []\n";
  std::vector<std::string> words{"cnem", "run", file, "--output", results, "--threads", "1"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  EXPECT_EQ(command_line(static_cast<int>(arguments.size()), arguments.data()), 3);
  const results::RunStatus status = results::read_status(results);
  EXPECT_NE(status.reason.find("tool 'foil' is too fast at step"), std::string::npos) << status.reason;
}

} // namespace
} // namespace cnem::app
