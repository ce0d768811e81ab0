// Passes through a workpiece that is not as high as the cut is deep.
#include "tests/finished_run.hpp"

#include "tests/stl_text.hpp"

#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>

namespace cnem::testing {
namespace {

constexpr const char* over_the_stock = R"toml(
[analysis]
type = "milling"

[cutter]
diameter = "12 mm"
teeth = 2

[cutting.forces]
law = "linear"
Ktc = "600 MPa"
Krc = "200 MPa"

[milling]
speed = "5000 rpm"
feed = "0.2 mm"
axial_depth = "2 mm"
side = "down"
workpiece = { stl = { file = "stock.stl" } }

[[milling.passes]]
start = "-8 5 mm"
path = [{ to = "18 5 mm" }]

[dexels]
layers = 4
steps = 720
)toml";

} // namespace

TEST(MillingPasses, SurfaceIsThatOfTheLayersOfTheStock) {
  const TemporaryFolder folder("stock");
  std::ofstream(folder.path() / "stock.stl") << stl_box({0, -5, 0}, {10, 0, 1.5});
  std::ofstream(folder.path() / "case.toml") << over_the_stock;
  const FinishedRun done = finish(input::read_case((folder.path() / "case.toml").string()));
  EXPECT_NEAR(done.metric("milling.peak_to_valley"), 0.2e-3 * 0.2e-3 / (8.0 * 6e-3), 1e-7); // f²/8R
  EXPECT_NEAR(done.metric("milling.location_error"), 0.0, 1e-6);
  // The cutter takes 1 mm of the upper side of all of its 10 mm, 1.5 mm high.
  double removed = 0.0;
  for (const double of_step : done.of("removed")) removed += of_step;
  EXPECT_NEAR(removed, 10e-3 * 1e-3 * 1.5e-3, 2e-10);
}

namespace {

/// A stock with these upper corners, mm; its lower ones are (0, -5, 0) to (10, 0, 0).
std::string leaning_stock(const Vec3& low, const Vec3& high) {
  return stl_hexahedron({Vec3(0, -5, 0), Vec3(10, -5, 0), Vec3(0, 0, 0), Vec3(10, 0, 0), low,
                         Vec3(high.x(), low.y(), high.z()), Vec3(low.x(), high.y(), high.z()), high});
}

/// The way and what is left in each layer, of the last pass through a stock.
results::HistoryTable surface_of(const std::string& stock, results::RunStatus& status,
                                 std::string* grid = nullptr) {
  const TemporaryFolder folder("stock"), output("surface");
  std::ofstream(folder.path() / "stock.stl") << stock;
  std::ofstream(folder.path() / "case.toml") << over_the_stock;
  const input::Case input = input::read_case((folder.path() / "case.toml").string());
  EXPECT_EQ(app::run(input, {.output = output.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  status = results::read_status(output.path());
  if (grid) {
    std::ifstream file(output.path() / results::files::machined_surface_grid);
    grid->assign(std::istreambuf_iterator<char>(file), {});
  }
  return results::read_history(output.path() / results::files::machined_surface);
}

} // namespace

TEST(MillingPasses, SurfaceIsWhereAnyLayerOfTheStockReaches) { // its ends lean: 2 mm at the height of 2 mm
  results::RunStatus status;
  std::string grid;
  const results::HistoryTable surface = surface_of(leaning_stock({2, -5, 2}, {8, 0, 2}), status, &grid);
  ASSERT_EQ(surface.column.size(), 5U) << "the way and four layers";
  const std::vector<double>& way = surface.column[0];
  for (std::size_t layer = 0; layer < 4; ++layer) {
    const double height = 0.25e-3 + 0.5e-3 * static_cast<double>(layer), from = 8e-3 + height,
                 to = 18e-3 - height;
    for (std::size_t i = 0; i < way.size(); ++i) {
      const double left = surface.column[layer + 1][i];
      if (way[i] > from + 1e-4 && way[i] < to - 1e-4) {
        EXPECT_LT(std::abs(left), 2e-6) << way[i];
      } else if (way[i] < from - 1e-4 || way[i] > to + 1e-4) {
        EXPECT_TRUE(std::isnan(left)) << way[i];
      }
    }
  }
  EXPECT_EQ(grid.find("nan"), std::string::npos) << "VTK's reader ends there";
  const std::string mark = "SCALARS machined int 1\nLOOKUP_TABLE default\n";
  ASSERT_NE(grid.find(mark), std::string::npos);
  std::istringstream machined(grid.substr(grid.find(mark) + mark.size()));
  for (std::size_t layer = 0; layer < 4; ++layer)
    for (std::size_t i = 0; i < way.size(); ++i) {
      int is = -1;
      ASSERT_TRUE(machined >> is);
      EXPECT_EQ(is, std::isnan(surface.column[layer + 1][i]) ? 0 : 1) << way[i];
    }
  EXPECT_NEAR(way.front(), 8.25e-3, 0.05e-3);
  EXPECT_NEAR(way.back(), 17.75e-3, 0.05e-3);
  EXPECT_NEAR(status.metric("milling.peak_to_valley").value(), 0.2e-3 * 0.2e-3 / (8.0 * 6e-3), 1e-7);
}

TEST(MillingPasses, SurfaceIsWhereTheCutterHasTakenMatter) { // a chamfer that it does not reach, of 3 mm
  results::RunStatus status;
  const results::HistoryTable surface = surface_of(leaning_stock({0, -5, 2}, {10, -3, 2}), status);
  // The side at y = -1 mm is below the chamfer up to 2/3 mm: in the lowest layer alone.
  ASSERT_EQ(surface.column.size(), 2U);
  EXPECT_TRUE(status.metric("milling.bottom.Ra"));
  EXPECT_FALSE(status.metric("milling.middle.Ra")) << "a third of the height without a side";
  EXPECT_LT(std::abs(status.metric("milling.location_error").value()), 1e-6);
}

TEST(MillingPasses, SurfaceIsThatOfAThinWallAndNotOfARibBehindIt) { // of 0.3 mm when 1 mm is taken of it
  results::RunStatus status;
  surface_of(stl_box({0, -1.3, 0}, {10, 0, 2}) + stl_box({0, -5, 0}, {10, -1.6, 2}), status);
  EXPECT_LT(std::abs(status.metric("milling.location_error").value()), 1e-6);
  EXPECT_NEAR(status.metric("milling.peak_to_valley").value(), 0.2e-3 * 0.2e-3 / (8.0 * 6e-3), 1e-7);
}

TEST(MillingPasses, ThereIsNoSurfaceWhereNothingIsTaken) { // the stock lies out of reach
  results::RunStatus status;
  surface_of(stl_box({0, -5, 0}, {10, -1.2, 2}), status);
  EXPECT_NE(status.reason.find("takes nothing of its side"), std::string::npos) << status.reason;
}

TEST(MillingPasses, ChipGrowthIsThatBesideARigidRun) {
  const TemporaryFolder folder("growth");
  std::ofstream(folder.path() / "stock.stl") << stl_box({0, -5, 0}, {4, 0, 2});
  std::string coarse = over_the_stock;
  coarse.replace(coarse.find("steps = 720"), 11, "steps = 180");
  const auto run = [&](const std::string& modes) {
    std::ofstream(folder.path() / "case.toml") << coarse << modes;
    return finish(input::read_case((folder.path() / "case.toml").string()));
  };
  const auto tool = [](const char* stiffness) {
    return fmt::format("[modes.y]\nfrequency = \"700 Hz\"\ndamping = 0.05\nstiffness = \"{}\"\n"
                       "direction = \"0 1 0\"\n",
                       stiffness);
  };
  const double rigid = run("").metric("milling.thickest");
  const FinishedRun stiff = run(tool("1e6 N/um")), soft = run(tool("3 N/um"));
  EXPECT_NEAR(stiff.metric("milling.chip_growth"), 1.0, 1e-4);
  EXPECT_NEAR(soft.metric("milling.chip_growth"), soft.metric("milling.thickest") / rigid, 1e-12);
  EXPECT_GT(std::abs(soft.metric("milling.chip_growth") - 1.0), 0.01);
}

} // namespace cnem::testing
