// What the report of a cut says of perfectly plastic metal without friction, on a coarse cloud.
#include "evaluate/cutting_result.hpp"
#include "tests/finished_run.hpp"

#include <cmath>
#include <filesystem>

namespace cnem::testing {
namespace {

/// Measured: Fc 155 kN/m on this cloud, 143 on a fine one.
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
  EXPECT_NEAR(done.metric("cutting.friction_angle"), 0.0, 3.0);
  EXPECT_NEAR(done.metric("cutting.shear_angle_speed"), 42.0, 8.0);
  EXPECT_GT(done.metric("cutting.contact_length"), 0.1e-3);
  EXPECT_LT(done.metric("cutting.contact_length"), 1.0e-3);
  EXPECT_TRUE(std::isnan(done.metric("cutting.tooth_spacing")));
  EXPECT_TRUE(std::isnan(done.metric("cutting.temperature_max"))) << "without heat";
  EXPECT_EQ(done.status.flags, std::vector<std::string>{"cutting.steady"});
}

} // namespace
} // namespace cnem::testing
