// What the report of a cut says of perfectly plastic metal without friction, on a coarse cloud.
#include "evaluate/cutting_result.hpp"
#include "tests/finished_run.hpp"

#include <cmath>
#include <numbers>

namespace cnem::testing {
namespace {

/// What acts on the rake face acts along its normal; the rounded edge ploughs.
TEST(CuttingReport, of_a_frictionless_cut_has_its_force_along_the_normal_of_the_rake_face) {
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/edge_flow/case.toml",
                       {"cloud.spacing=0.1 mm", "adapt.tool_spacing=0.02 mm", "time.end=75 us",
                        "output.pictures=[]", "output.fields_every=1 s", "report.cutting.width=4 mm"});
  const FinishedRun done = finish(input);
  expect_nothing_lost(done);
  const double Fc = done.metric("cutting.Fc"), Ft = done.metric("cutting.Ft");
  EXPECT_GT(Fc, 4.0 * 115.9); // Lee and Shaffer's, which coarse clouds are above
  EXPECT_LT(Fc, 4.0 * 180.0);
  EXPECT_LT(Ft, 0.0) << "the tool is drawn in";
  const double edge_Fc = done.metric("cutting.edge_Fc"), edge_Ft = done.metric("cutting.edge_Ft");
  EXPECT_NEAR((Ft - edge_Ft) / (Fc - edge_Fc), -std::tan(17.5 * std::numbers::pi / 180.0), 0.02);
  EXPECT_GT(edge_Fc, 0.0);
  EXPECT_LT(edge_Fc, 0.2 * Fc);
  EXPECT_NEAR(done.metric("cutting.shear_angle_speed"), 42.0, 8.0);
  // One of the chips that slip lines admit, with the curl that goes with its thickness (docs/slip_lines.md).
  const double ratio = done.metric("cutting.chip_ratio");
  EXPECT_GT(ratio, 1.016);
  EXPECT_LT(ratio, 1.64);
  EXPECT_NEAR(done.metric("cutting.curl_radius") / 0.3e-3, 3.4, 0.7) << ratio;
  EXPECT_GT(done.metric("cutting.contact_length"), 0.1e-3);
  EXPECT_LT(done.metric("cutting.contact_length"), 1.0e-3);
  EXPECT_TRUE(std::isnan(done.metric("cutting.tooth_spacing")));
  EXPECT_TRUE(std::isnan(done.metric("cutting.temperature_max"))) << "without heat";
  // What the edge has burnished is pressed along the surface.
  const double residual = done.metric("cutting.residual_stress_surface");
  EXPECT_LT(residual, -0.05 * 440e6);
  EXPECT_GT(residual, -440e6);
  EXPECT_GT(done.metric("cutting.residual_yield"), -residual / 440e6 * 0.5);
  EXPECT_LT(done.metric("cutting.residual_yield"), 1.0);
  EXPECT_EQ(done.status.flags, std::vector<std::string>{"cutting.steady"});
}

/// Heat that leaves a workpiece which expands draws its surface out; a bond is not let go.
TEST(CuttingReport, residual_stress_has_the_share_of_heat_and_none_with_ties) {
  const auto surface_of = [](const std::vector<std::string>& more) {
    std::vector<std::string> overrides{"analysis.thermal=true",
                                       "materials.aluminium.heat.specific_heat=\"900 J/(kg K)\"",
                                       "materials.aluminium.heat.conductivity=\"150 W/(m K)\"",
                                       "cloud.spacing=0.1 mm",
                                       "adapt.tool_spacing=0.02 mm",
                                       "tools.cutter.velocity=\"40 0 m/s\"",
                                       "time.end=25 us",
                                       "output.pictures=[]",
                                       "output.fields_every=1 s"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const FinishedRun done = finish(input::read_case(
        std::string(CNEM_SOURCE_DIR) + "/cases/verification/edge_flow/case.toml", overrides));
    EXPECT_GT(done.metric("cutting.roughness"), 0.0);
    return done.metric("cutting.residual_stress_surface");
  };
  const double pressed = surface_of({}),
               drawn = surface_of({"materials.aluminium.heat.expansion=\"2.3e-5 1/K\""});
  EXPECT_GT(drawn - pressed, 50e6);
  EXPECT_TRUE(std::isnan(surface_of({"domain.interfaces.joint.points=[\"2.8 0 mm\", \"2.8 0.8 mm\"]"})));
}

} // namespace
} // namespace cnem::testing
