// Static analyses of bodies in space, as the program runs and checks them.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/fields.hpp"
#include "results/history_writer.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <variant>

namespace cnem::app {
namespace {

/// A box 4 × 2 × 1 mm on three planes of symmetry.
input::Case box(const std::string& more) {
  return input::read_case_text(R"toml(
[analysis]
type = "static"
kinematics = "three-dimensional"
[domain]
material = "steel"
block = { from = "0 0 0 mm", to = "4 2 1 mm" }
[cloud]
spacing = "0.5 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "200 GPa", poisson = 0.25 }
[boundary.planes]
pieces = ["x-", "y-", "z-"]
symmetry = true
)toml" + more,
                               "box.toml");
}

class SpaceStatics : public ::testing::Test {
protected:
  RunOptions options() const { return {.output = temporary.path() / "out", .version = "test"}; }
  double history(const std::string& name) const {
    const results::HistoryTable table = results::read_history(options().output / "history.csv");
    return table.find(name) < 0 ? std::nan("") : table.column[index_of(table.find(name))].front();
  }
  const cnem::testing::TemporaryFolder temporary{"space_statics"};
};

TEST_F(SpaceStatics, a_box_under_tractions_is_strained_as_hooke_says_and_leaves_its_files) {
  const input::Case input = box("[boundary.pull]\npieces = \"x+\"\ntraction = \"100 0 0 MPa\"\n"
                                "[boundary.press]\npieces = \"z+\"\npressure = \"40 MPa\"\n");
  RunObserver silent;
  app::Run whole(input, options(), silent);
  ASSERT_EQ(whole.go_on(), Exit::done);
  const auto shot = std::get<results::Snapshot<3>>(whole.session().snapshot());
  const double E = 200e9, nu = 0.25, pull = 100e6, press = -40e6;
  const Vec<3> strain((pull - nu * press) / E, -nu * (pull + press) / E, (press - nu * pull) / E);
  for (std::size_t i = 0; i < shot.state.node.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = shot.state.node.initial_position[k][i];
      const double start = k == 0 ? -input.origin.x() : k == 1 ? -input.origin.y() : -input.origin.z();
      EXPECT_NEAR(shot.state.node.position[k][i] - x, strain[as<Eigen::Index>(k)] * (x - start), 1e-15);
    }
  const Field stress = results::values_at_points(shot, "stress_zz");
  for (const double s : stress) EXPECT_NEAR(s, press, 1.0);
  for (const double s : results::values_at_points(shot, "equivalent_stress"))
    EXPECT_NEAR(s, std::sqrt(pull * pull + press * press - pull * press), 1.0);

  EXPECT_NEAR(history("support.planes.force_x[N]"), -pull * 2e-6, 1e-6);
  EXPECT_NEAR(history("support.planes.force_y[N]"), 0.0, 1e-6);
  EXPECT_NEAR(history("support.planes.force_z[N]"), -press * 8e-6, 1e-6);
  const double energy = 0.5 * (pull * strain.x() + press * strain.z()) * 8e-9;
  EXPECT_NEAR(history("energy.elastic[J]"), energy, 1e-9 * energy);
  EXPECT_NEAR(history("energy.external_work[J]"), energy, 1e-9 * energy);
  EXPECT_NEAR(history("mass[kg]"), 7850.0 * 8e-9, 1e-15);
  EXPECT_NEAR(history("enclosed_volume[m^3]"), 8e-9 * (1.0 + strain.sum()), 1e-14);

  const results::RunStatus status = results::read_status(options().output);
  EXPECT_EQ(status.exit, 0);
  EXPECT_LT(status.energy_residual, 1e-12);
  for (const char* file : {"report.html", "fields.pvd", "pictures/displacement_z_000.png"})
    EXPECT_TRUE(std::filesystem::exists(options().output / file)) << file;
  std::ifstream album(options().output / "pictures/index.json");
  const std::string text{std::istreambuf_iterator<char>(album), {}};
  EXPECT_NE(text.find("Displacements are drawn"), std::string::npos);
}

TEST_F(SpaceStatics, faces_may_be_moved_and_heat_expands_what_is_free) {
  ASSERT_EQ(run(box("[boundary.move]\npieces = \"x+\"\ndisplacement = { x = \"4 um\" }\n"), options()),
            Exit::done);
  EXPECT_NEAR(history("support.move.force_x[N]"), 200e9 * 1e-3 * 2e-6, 1e-6);
  RunOptions again = options();
  again.force = true;
  input::Case hot = box("[initial]\ntemperature = \"400 K\"\n[materials.steel.heat]\nspecific_heat = \"500 "
                        "J/(kg K)\"\nconductivity = \"50 W/(m K)\"\nexpansion = \"1e-5 /K\"\n"
                        "reference_temperature = \"300 K\"\n");
  ASSERT_EQ(run(hot, again), Exit::done);
  EXPECT_NEAR(history("enclosed_volume[m^3]"), 8e-9 * std::pow(1.001, 3), 1e-17);
  EXPECT_NEAR(history("energy.elastic[J]"), 0.0, 1e-15);
}

TEST_F(SpaceStatics, all_methods_of_space_solve) {
  for (const char* method : {"name = \"fe-tetrahedra\"", "cells = \"voronoi\""}) {
    RunOptions kept = options();
    kept.force = true;
    ASSERT_EQ(
        run(box(std::string("[boundary.pull]\npieces = \"x+\"\ntraction = \"100 0 0 MPa\"\n[method]\n") +
                method),
            kept),
        Exit::done);
    EXPECT_NEAR(history("energy.elastic[J]"), 0.5 * 1e8 * 1e8 / 200e9 * 8e-9, 1e-13) << method;
  }
}

TEST_F(SpaceStatics, a_check_counts_unknowns_and_names_the_motion_that_is_free) {
  const Checked good = check(box(""), {});
  EXPECT_EQ(good.fault, "");
  const auto number = [&](const std::string& name) {
    for (const auto& [key, value] : good.numbers)
      if (key == name) return value;
    return -1.0;
  };
  EXPECT_EQ(number("nodes"), 9 * 5 * 3);
  EXPECT_EQ(number("unknowns"), 3 * 9 * 5 * 3);
  input::Case loose = box("");
  std::erase_if(loose.boundary.front().pieces, [](const std::string& piece) { return piece == "y-"; });
  EXPECT_NE(check(loose, {}).fault.find("translation along (0, 1, 0)"), std::string::npos)
      << check(loose, {}).fault;
}

} // namespace
} // namespace cnem::app
