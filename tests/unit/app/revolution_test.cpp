// Axisymmetric cases as a user writes them.
#include "app/problem/registry.hpp"
#include "app/run.hpp"
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "tests/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::app {
namespace {

constexpr const char* bar = R"toml(
[analysis]
kinematics = "axisymmetric"
[time]
end = "1 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "2 4 mm" }
[cloud]
spacing = "0.4 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[boundary.wall]
pieces = ["bottom"]
symmetry = true
[initial]
velocity = "0 -10 m/s"
[output]
history_every = "0.1 us"
)toml";

class Axisymmetric : public ::testing::Test {
protected:
  void SetUp() override { std::ofstream(folder / "bar.toml") << bar; }
  input::Case read(const std::vector<std::string>& overrides) {
    return input::read_case((folder / "bar.toml").string(), overrides);
  }
  std::string refusal(const std::vector<std::string>& overrides) {
    try {
      build<2>(read(overrides));
    } catch (const InputError& error) { return error.what(); }
    return "";
  }
  const cnem::testing::TemporaryFolder temporary{"axisymmetric"};
  const std::filesystem::path& folder = temporary.path();
};

TEST_F(Axisymmetric, the_workpiece_must_not_cross_the_axis) {
  const std::string message = refusal({"domain.outer.rectangle.from=\"-1 0 mm\""});
  EXPECT_NE(message.find("x = -0.001 m, expected x >= 0"), std::string::npos) << message;
  EXPECT_EQ(refusal({"domain.outer.rectangle.from=\"1 0 mm\""}), "");
}

TEST_F(Axisymmetric, radial_motion_prescribed_on_the_axis_is_warned_of) {
  EXPECT_TRUE(build<2>(read({})).warnings.empty());
  const app::Setup<2> setup =
      build<2>(read({"boundary.pull={ pieces = [\"top\"], velocity = { x = \"1 m/s\" } }"}));
  ASSERT_EQ(setup.warnings.size(), 1U);
  EXPECT_NE(setup.warnings[0].find("boundary.pull moves nodes on the axis"), std::string::npos);
}

TEST_F(Axisymmetric, statics_refuses_cracks) {
  const std::string message = refusal({"analysis.type=\"static\"", "initial={}", "time={}",
                                       "domain.cracks.main.points=[\"0.5 2 mm\", \"1.5 2 mm\"]"});
  EXPECT_NE(message.find("domain.cracks': found in an axisymmetric static analysis"), std::string::npos)
      << message;
}

TEST_F(Axisymmetric, nodes_on_the_axis_are_held_and_at_least_two_gauss_points_taken) {
  const app::Setup<2> setup = build<2>(read({}));
  const auto& supports = setup.problem.supports.list();
  ASSERT_EQ(supports.size(), 2U);
  EXPECT_EQ(supports[0].name, "axis");
  EXPECT_EQ(supports[0].nodes.size(), 11U);
  EXPECT_EQ(read({}).method.options.gauss_points, 2);
  EXPECT_EQ(build<2>(read({"domain.outer.rectangle.from=\"1 0 mm\""})).problem.supports.list().size(), 1U);
}

TEST_F(Axisymmetric, history_counts_the_whole_body) {
  RunOptions options;
  options.output = folder / "out";
  ASSERT_EQ(run(read({}), options), Exit::done);
  const results::HistoryTable history = results::read_history(folder / "out" / "history.csv");
  for (const char* name : {"mass[kg]", "energy.kinetic[J]", "support.wall.force_y[N]"})
    EXPECT_GE(history.find(name), 0) << name;
  std::ifstream report(folder / "out" / "report.html");
  const std::string html{std::istreambuf_iterator<char>(report), {}};
  EXPECT_NE(html.find("axisymmetric: x is the radius"), std::string::npos);
  const double mass = 7850.0 * std::numbers::pi * 4e-6 * 4e-3;
  const auto first = [&](const char* name) {
    return history.column[static_cast<std::size_t>(history.find(name))].front();
  };
  EXPECT_NEAR(first("mass[kg]"), mass, 1e-12 * mass);
  EXPECT_NEAR(first("energy.kinetic[J]"), 50.0 * mass, 1e-9 * mass);
}

} // namespace
} // namespace cnem::app
