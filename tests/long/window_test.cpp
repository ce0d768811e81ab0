// A cut through a window that moves with the tool, beside the same one in the whole workpiece.
#include "evaluate/cutting_result.hpp"
#include "tests/verification/adapted_run.hpp"

namespace cnem::testing {
namespace {

const std::string cut = aluminium_cut + R"toml(
[time.mass_scaling]
factor = 1 # inertia acts at this speed
[cloud]
spacing = "0.12 mm"
[adapt]
tool_spacing = "10 um" # finer cells make short steps of masses as they are
surface_spacing = "0.03 mm"
indicator = { h_min = "0.03 mm", h_max = "0.06 mm" }
[output]
fields_every = "0 s"
)toml";
const Texts faster{"cutting.rake=17.5 deg", "cutting.edge_radius=40 um", "cutting.speed=3200 m/min",
                   "cutting.length=1.8 mm"};

TEST(MovingWindow, changes_nothing_near_the_tool) {
  // Whether a node slips through at the edge, in 20,000 steps, is up to rounding: none with AVX-512, one
  // without.
  constexpr double residual = 5e-4;
  constexpr int outside = 1;
  const Adapted whole = testing::run(cut, faster, residual, outside),
                window = testing::run(cut,
                                      with(faster, {"cutting.window=true", "adapt.window.ahead=1.8 mm",
                                                    "adapt.window.behind=0.9 mm", "adapt.window.chip=0.9 mm",
                                                    "domain.outer.rectangle.to=1.9 0.3 mm"}),
                                      residual, outside);
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
