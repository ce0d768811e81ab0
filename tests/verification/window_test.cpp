// A cut through a window that moves with the tool, beside the same one in the whole workpiece.
#include "evaluate/cutting_result.hpp"
#include "tests/verification/adapted_run.hpp"

namespace cnem::testing {
namespace {

const std::string cut = R"toml(
[cutting]
feed = "0.3 mm"
width = "4 mm"
rake = "17.5 deg"
clearance = "7 deg"
edge_radius = "40 um"
speed = "3200 m/min"
length = "1.8 mm"
[time.mass_scaling]
factor = 1 # inertia acts at this speed
[domain]
material = "aluminium"
[cloud]
spacing = "0.12 mm"
[adapt]
surface_spacing = "0.03 mm"
indicator = { h_min = "0.03 mm", h_max = "0.06 mm" }
[output]
fields_every = "0 s"
[materials.aluminium]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "perfect", yield = "440 MPa" }
)toml";

TEST(MovingWindow, changes_nothing_near_the_tool) {
  const Adapted whole = testing::run(cut),
                window = testing::run(cut, {"cutting.window=true", "adapt.window.ahead=1.8 mm",
                                            "adapt.window.behind=0.9 mm", "adapt.window.chip=0.9 mm",
                                            "domain.outer.rectangle.to=1.9 0.3 mm"});
  const auto metric = [&](const Adapted& of, const char* name) {
    return of.metric(std::string("cutting.") + name);
  };
  EXPECT_NEAR(metric(window, "Fc"), metric(whole, "Fc"), 0.02 * metric(whole, "Fc"));
  EXPECT_NEAR(metric(window, "chip_thickness"), metric(whole, "chip_thickness"),
              0.03 * metric(whole, "chip_thickness"));
  EXPECT_LT(window.column("nodes").back(), 0.9 * whole.column("nodes").back());
  EXPECT_GT(window.metric("window.fed"), 50.0);
  EXPECT_GT(window.metric("window.taken_off"), 50.0);
  EXPECT_EQ(window.metric("window.refused"), 0.0);
  EXPECT_LT(std::abs(window.metric("area_drift")), 5e-3);
}

} // namespace
} // namespace cnem::testing
