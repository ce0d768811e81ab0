// Runs that diverge, and runs that do not: exit code, post-mortem, the last good state.
#include "results/status.hpp"
#include "tests/unit/app/command_line_fixture.hpp"

#include <sstream>

namespace cnem::app {
namespace {

using DivergedRun = CommandLine;

TEST_F(DivergedRun, divergence_exits_with_3_and_names_node_step_and_field) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "time.step.fixed=0.4 us"}), 3);
  const results::RunStatus status = results::read_status(results());
  EXPECT_EQ(status.exit, 3);
  ASSERT_TRUE(status.post_mortem.has_value());
  EXPECT_GE(status.post_mortem->node, 0);
  EXPECT_FALSE(status.post_mortem->field.empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "fields.pvd")) << "the last good state stays";
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "checkpoint.h5"));
  EXPECT_NE(status.post_mortem->last_good.find("checkpoint.h5"), std::string::npos);
}

TEST_F(DivergedRun, the_post_mortem_names_likely_causes_and_shows_the_place) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "time.step.fixed=0.4 us", "--set",
                  "method.stabilisation=0"}),
            3);
  const results::PostMortem post = results::read_status(results()).post_mortem.value();
  std::string causes;
  for (const std::string& cause : post.causes) causes += cause + "\n";
  for (const char* word : {"time.step.fixed", "method.stabilisation"})
    EXPECT_NE(causes.find(word), std::string::npos) << causes;
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "pictures" / post.picture)) << post.picture;
  std::stringstream report;
  report << std::ifstream(folder / "results" / "report.html").rdbuf();
  for (const char* text : {"Likely causes", "Last good state", "where it went wrong"})
    EXPECT_NE(report.str().find(text), std::string::npos) << text;
}

TEST_F(DivergedRun, a_step_that_collapses_is_a_divergence_with_a_place) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "time.step.min=1 us"}), 3);
  const results::PostMortem post = results::read_status(results()).post_mortem.value();
  EXPECT_EQ(post.field, "stable step");
  EXPECT_NE(post.text.find("time.step.min"), std::string::npos) << post.text;
  EXPECT_GE(post.node, 0);
}

TEST_F(DivergedRun, a_spring_that_limits_the_step_is_blamed_and_no_node) {
  std::vector<std::string> words{"check", file(), "--output", results()};
  for (const char* change : {"tools.punch.mass=1e-6 kg/m", "tools.punch.direction=0 -1",
                             "tools.punch.spring={law=\"linear\", stiffness=\"100 GN/m2\"}"})
    words.insert(words.end(), {"--set", change});
  ASSERT_EQ(call(words), 0) << message;
  EXPECT_NE(printed.find("limited by springs of tools\n"), std::string::npos) << printed;
  words.front() = "run";
  words.insert(words.end(), {"--set", "time.step.min=1 us", "--force"});
  ASSERT_EQ(call(words), 3) << message;
  const results::PostMortem post = results::read_status(results()).post_mortem.value();
  EXPECT_EQ(post.node, -1);
  EXPECT_NE(post.text.find("because of springs of tools"), std::string::npos) << post.text;
}

TEST_F(DivergedRun, an_energy_residual_beyond_the_key_is_a_divergence) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "method.energy_tolerance=1e-12"}), 3);
  const results::PostMortem post = results::read_status(results()).post_mortem.value();
  EXPECT_EQ(post.field, "energy residual");
  EXPECT_NE(post.causes.front().find("method.energy_tolerance"), std::string::npos) << post.causes.front();
}

TEST_F(DivergedRun, the_energy_is_judged_at_the_end_too) {
  const auto ends_after = [&](const std::string& steps) {
    return call({"run", file(), "--output", results(), "--force", "--set", "method.energy_tolerance=1e-12",
                 "--set", "output.history_every=1 s", "--set", "time.max_steps=" + steps});
  };
  EXPECT_EQ(ends_after("20"), 3) << "the last row of a history with no other";
  EXPECT_EQ(call({"run", file(), "--output", results(), "--force", "--set", "method.energy_tolerance=1e-12",
                  "--set", "output.history_every=1 s"}),
            3);
}

TEST_F(DivergedRun, a_body_that_expands_under_a_small_load_is_no_divergence) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "tools.punch.velocity=0 0 m/s", "--set",
                  "materials.steel.heat.expansion=1.2e-5 1/K", "--set", "boundary.hot.pieces=left", "--set",
                  "boundary.hot.temperature={value = \"600 K\", from = \"293.15 K\", ramp = \"1 us\"}",
                  "--set", "boundary.top.pieces=right", "--set", "boundary.top.pressure=1 Pa"}),
            0)
      << message;
}

TEST_F(DivergedRun, a_body_at_rest_is_no_divergence) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "tools.punch.velocity=0 0 m/s"}), 0)
      << message;
}

TEST_F(DivergedRun, an_energy_residual_where_nothing_did_work_is_a_divergence) {
  // A step too long for the cells: the rounding of a body at rest doubles from step to step.
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "tools.punch.velocity=0 0 m/s", "--set",
                  "time.step.fixed=0.12 us", "--set", "time.max_steps=13", "--set",
                  "output.fields_every=2 us", "--set", "output.history_every=0 s"}),
            3)
      << message;
  const results::PostMortem post = results::read_status(results()).post_mortem.value();
  EXPECT_EQ(post.field, "energy residual");
  EXPECT_NE(post.text.find("where nothing has done work"), std::string::npos) << post.text;
}

TEST_F(DivergedRun, a_static_solution_that_is_no_number_is_a_divergence) {
  std::ofstream(folder / "pulled.toml") << R"toml(
analysis.type = "static"
domain = { material = "steel", outer.rectangle = { from = "0 0 mm", to = "4 2 mm" } }
cloud.spacing = "0.4 mm"
materials.steel = { density = "7850 kg/m3", elastic = { young = "210 GPa", poisson = 0.3 } }
boundary.base = { pieces = ["bottom"], displacement = "0 0 mm" }
boundary.top = { pieces = ["top"], traction = "0 1e300 Pa" }
)toml";
  ASSERT_EQ(call({"run", (folder / "pulled.toml").string(), "--output", results()}), 3) << message;
  const results::RunStatus status = results::read_status(results());
  EXPECT_EQ(status.exit, 3);
  const results::PostMortem post = status.post_mortem.value();
  EXPECT_FALSE(post.field.empty());
  EXPECT_GE(post.node, 0);
  EXPECT_NE(post.text.find("the " + post.field + " of the static solution is "), std::string::npos)
      << post.text;
  EXPECT_NE(printed.find(post.text), std::string::npos) << printed;
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "report.html"));
}

} // namespace
} // namespace cnem::app
