// Three-dimensional cases: what the reader and the registry make of blocks, and what the program writes.
#include "app/problem/registry.hpp"
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/point_weights.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::app {
namespace {

input::Case read(const std::string& block, const std::string& more = "") {
  return input::read_case_text(fmt::format(R"(
[analysis]
kinematics = "three-dimensional"
[time]
end = "2 us"
[domain]
material = "steel"
block = {{ {} }}
[cloud]
spacing = "0.5 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = {{ young = "210 GPa", poisson = 0.3 }}
[method]
lagrangian = "total"
{})",
                                           block, more),
                               "case.toml");
}

double volume(const Cloud<3>& cloud) { return enclosed_measure(cloud); }

// As bodies without a grid are warned of.
TEST(SpaceGrid, thinner_than_its_spacing_is_told) {
  const auto warnings = [](const std::string& to) {
    return build<3>(read("from = \"0 0 0 mm\", to = \"" + to + "\"")).warnings;
  };
  EXPECT_TRUE(warnings("4 2 0.5 mm").empty()) << "one layer as it was asked for";
  const auto thin = warnings("4 2 0.4 mm");
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_NE(thin[0].find("the domain is 0.0004 m thick along z, less than the spacing, 0.0005 m"),
            std::string::npos)
      << thin[0];
}

TEST(Space, a_box_has_its_faces_and_its_volume) {
  const app::Setup<3> setup = build<3>(read(R"(from = "4 2 3 mm", to = "0 1 1 mm")"));
  const Cloud<3>& cloud = setup.problem.cloud;
  EXPECT_EQ(cloud.nodes(), 9 * 3 * 5);
  EXPECT_NEAR(volume(cloud), 8e-9, 1e-21);
  EXPECT_EQ(cloud.piece_names, (std::vector<std::string>{"x-", "x+", "y-", "y+", "z-", "z+"}));
}

TEST(Space, parts_of_a_cylinder_are_cut_where_they_say) {
  const auto cylinder = [](const std::string& part) {
    const input::Case input = read(fmt::format(
        R"(shape = "cylinder", centre = "1 2 3 mm", radius = "2 mm", length = "3 mm", part = "{}")", part));
    Cloud<3> cloud = build<3>(input).problem.cloud;
    for (Vec3& x : cloud.position) x += input.origin - Vec3(1e-3, 2e-3, 3e-3);
    return cloud;
  };
  const double whole = std::numbers::pi * 12e-9;
  for (const auto& [part, share] : {std::pair("whole", 1.0), {"half", 0.5}, {"quarter", 0.25}}) {
    const Cloud<3> cloud = cylinder(part);
    const double found = volume(cloud) / (share * whole);
    EXPECT_LT(found, 1.0) << part;
    EXPECT_GT(found, 0.98) << part; // a polygon of 16 corners a quarter of the way round
    for (const Facet<3>& facet : cloud.facets) {
      const std::string& piece = cloud.piece_names[facet.piece];
      for (const NodeIndex i : facet.node) {
        const Vec3& x = cloud.position[i];
        const double off = piece == "bottom" ? x.z()
                           : piece == "top"  ? x.z() - 3e-3
                           : piece == "x-"   ? x.x()
                           : piece == "y-"   ? x.y()
                                             : std::hypot(x.x(), x.y()) - 2e-3;
        EXPECT_NEAR(off, 0.0, 1e-15) << part << " " << piece;
      }
    }
  }
}

TEST(Space, weights_of_a_point_reproduce_it) {
  app::Setup<3> setup = build<3>(read(R"(from = "0 0 0 mm", to = "2 2 1 mm")"));
  const Cloud<3>& cloud = setup.problem.cloud;
  const Approximation<3> approximation = setup.problem.method->rebuild(cloud);
  const results::PointLocator<3> locator(cloud, approximation.cells);
  for (const Vec3& x : {Vec3(1e-3, 0.3e-3, 0.7e-3), Vec3(2e-3, 2e-3, 1e-3), Vec3(0.51e-3, 1.99e-3, 0.0)}) {
    const results::PointWeights point = locator.weights(x);
    Vec3 found = Vec3::Zero();
    for (std::size_t k = 0; k < point.node.size(); ++k) {
      found += point.weight[k] * cloud.position[point.node[k]];
      EXPECT_GT(point.weight[k], -1e-9);
    }
    EXPECT_LT((found - x).norm(), 1e-16);
  }
  EXPECT_THROW(locator.weights(Vec3(2.1e-3, 1e-3, 0.5e-3)), GeometryError);
  EXPECT_EQ(locator.nearest_node(Vec3(2.1e-3, 2.1e-3, 1.2e-3)).weight, std::vector<double>{1.0});
}

// A box under a vertical pull of 100 MPa that sets in slowly, its sides free: u_z = σ h/E, u_x = −ν σ l/E.
TEST(Space, a_pulled_box_runs_through_the_program) {
  const cnem::testing::TemporaryFolder folder("space");
  const input::Case input = read(R"(from = "0 0 0 mm", to = "1 1 2 mm")", R"(
[boundary.planes]
pieces = ["x-", "y-", "z-"]
symmetry = true
[boundary.pull]
pieces = ["z+"]
traction = { z = { value = "100 MPa", ramp = "40 us", smooth = true } }
[output]
history_every = "10 us"
probes.corner = { at = "1 1 2 mm", fields = ["displacement_x", "displacement_z"] }
probes.middle = { at = "0.4 0.5 1.1 mm", fields = ["stress_zz", "stress_xx"] }
lines.axis = { from = "0 0 0 mm", to = "0 0 2 mm", samples = 3, fields = ["displacement_z"] }
)");
  input::Case longer = input;
  longer.time.end = 50e-6;
  ASSERT_EQ(run(longer, {.output = folder.path(), .force = true, .version = "test"}), Exit::done);
  const results::HistoryTable history = results::read_history(folder.path() / "history.csv");
  const auto last = [&](const std::string& name) {
    const int column = history.find(name);
    EXPECT_GE(column, 0) << name;
    return history.column.at(static_cast<std::size_t>(column)).back();
  };
  EXPECT_NEAR(last("probe.corner.displacement_z"), 1e8 * 2e-3 / 210e9, 0.01 * 1e8 * 2e-3 / 210e9);
  EXPECT_NEAR(last("probe.corner.displacement_x"), -0.3 * 1e8 * 1e-3 / 210e9, 0.01 * 1e8 * 1e-3 / 210e9);
  EXPECT_NEAR(last("probe.middle.stress_zz"), 1e8, 1e6);
  EXPECT_NEAR(last("probe.middle.stress_xx"), 0.0, 1e6);
  EXPECT_NEAR(last("support.planes.force_z"), -1e8 * 1e-6, 1.0);
  EXPECT_NEAR(last("mass"), 7850 * 2e-9, 1e-15);
  EXPECT_LT(results::read_status(folder.path()).energy_residual, 1e-3);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "lines" / "axis.csv"));
  const std::string report = results::read_file(folder.path() / "report.html");
  EXPECT_NE(report.find("three-dimensional"), std::string::npos);
  EXPECT_NE(report.find("Mass and enclosed volume"), std::string::npos);
  EXPECT_EQ(report.find("axisymmetric"), std::string::npos);
}

} // namespace
} // namespace cnem::app
