// Tools that are too fast for their contact to be seen, and how a user learns of it.
#include "app/watches/tool_speed.hpp"

#include "app/command_line.hpp"
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "results/status.hpp"
#include "tests/solver_of.hpp"
#include "tests/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// Dilatational waves: 6001 m/s, the first step about 4e-8 s.
const std::string resting_block = R"toml(
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

input::Case read_with(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return input::read_case_text(resting_block + more, "case.toml", overrides);
}

std::string punch(const std::string& velocity) {
  return "[tools.punch]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 4.1 mm\" }\nvelocity = " + velocity +
         "\n";
}

std::vector<std::string> warnings_of(const input::Case& input) {
  return supersonic_tools(input, testing::solver_of(input));
}

TEST(ToolSpeed, of_sound_is_a_warning) {
  EXPECT_TRUE(warnings_of(read_with(punch("\"0 -5900 m/s\""))).empty());
  const auto fast = warnings_of(read_with(punch("\"0 -6100 m/s\"")));
  ASSERT_EQ(fast.size(), 1U);
  EXPECT_NE(
      fast[0].find("tools.punch and the workpiece meet at 6100 m/s, faster than sound in 'steel' (6001 m/s)"),
      std::string::npos)
      << fast[0];
  EXPECT_EQ(warnings_of(read_with(punch(
                            "{ times = \"0 1 2 us\", values = [\"0 0 m/s\", \"0 -7 km/s\", \"0 0 m/s\"] }")))
                .size(),
            1U)
      << "in the middle of the run";
  EXPECT_TRUE(
      warnings_of(
          read_with(punch("{ times = \"0 3 4 us\", values = [\"0 0 m/s\", \"0 0 m/s\", \"0 -7 km/s\"] }")))
          .empty())
      << "after its end";
  EXPECT_EQ(warnings_of(read_with(punch("\"0 -4 km/s\"") + "[initial]\nvelocity = \"0 3 km/s\"\n")).size(),
            1U)
      << "towards each other";
  EXPECT_EQ(warnings_of(read_with(punch("\"0 -70 m/s\""), {"time.mass_scaling.factor=1e4"})).size(), 1U)
      << "scaled masses slow the waves";
}

TEST(ToolSpeed, of_more_than_its_thickness_a_step_is_refused) {
  const std::string foil =
      "[tools.punch]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 2.2 mm\" }\nvelocity = \"0 -1 km/s\"\n";
  const input::Case input = read_with(foil);
  const ExplicitSolver<2> solver = testing::solver_of(input);
  EXPECT_NO_THROW(check_tool_steps(input, solver, 0.99e-7));
  EXPECT_THROW(check_tool_steps(input, solver, 1.01e-7), InputError);
  EXPECT_NO_THROW(check_tool_steps(read_with(foil, {"time.end=90 ns"}), solver, 1.0))
      << "no step is longer than a run";
}

/// What a run with these tools comes to.
results::RunStatus run(const std::string& more, int expected) {
  const cnem::testing::TemporaryFolder folder("tool_speed");
  const std::string file = (folder.path() / "case.toml").string(),
                    results = (folder.path() / "results").string();
  std::ofstream(file) << resting_block << more << "[output]\npictures = []\n";
  std::vector<std::string> words{"cnem", "run", file, "--output", results, "--threads", "1"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  EXPECT_EQ(command_line(static_cast<int>(arguments.size()), arguments.data()), expected);
  return results::read_status(results);
}

TEST(ToolSpeed, that_a_force_brings_ends_the_run) {
  const results::RunStatus status =
      run("[tools.foil]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 2.11 mm\" }\nmass = \"0.1 kg/m\"\n"
          "direction = \"0 1\"\nforce = \"0 -100 MN/m\"\n",
          3);
  EXPECT_NE(status.reason.find("went through tool 'foil' unseen, from one side to the other"),
            std::string::npos)
      << status.reason;
}

TEST(ToolSpeed, of_a_body_that_a_support_drives_past_ends_the_run) {
  const results::RunStatus status =
      run("[tools.foil]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 2.102 mm\" }\n"
          "[boundary.top]\npieces = [\"top\"]\n"
          "velocity = { y = { times = \"0 0.5 2 us\", values = \"0 800 800 m/s\" } }\n",
          3);
  EXPECT_NE(status.reason.find("went through tool 'foil' unseen"), std::string::npos) << status.reason;
}

TEST(ToolSpeed, a_support_that_drives_nodes_into_a_tool_is_a_warning) {
  const std::string wall = "[tools.wall]\nrectangle = { from = \"-1 2.1 mm\", to = \"5 4 mm\" }\n"
                           "[boundary.top]\npieces = [\"top\"]\nvelocity = { y = \"200 m/s\" }\n";
  const results::RunStatus status = run(wall, 0);
  ASSERT_EQ(status.warnings.size(), 1U);
  EXPECT_NE(status.warnings[0].find("deep in tool 'wall' at step"), std::string::npos) << status.warnings[0];
}

} // namespace
} // namespace cnem::app
