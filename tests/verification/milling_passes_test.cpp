// Passes through a workpiece that is not as high as the cut is deep.
#include "tests/finished_run.hpp"

#include "tests/stl_text.hpp"

#include <fstream>

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

} // namespace cnem::testing
