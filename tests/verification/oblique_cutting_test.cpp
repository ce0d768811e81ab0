// cases/three_dimensions/oblique_cutting on a coarse cloud, its first 40 um, between periodic planes: what
// the tool's place and turn do.
#include "tests/finished_run.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

/// Mean force on the tool beyond the first 10 um of cut, N.
struct Force {
  double cutting = 0.0, side = 0.0;
};

Force cut_at(const std::string& inclination, const std::string& friction = "0.17") {
  const FinishedRun done = finish(
      input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/oblique_cutting/case.toml",
                       {"let.inclination=" + inclination, "let.width=0.4 mm", "let.length=0.04 mm",
                        "tools.cutter.friction.coefficient=" + friction, "cloud.refine.layer.spacing=60 um",
                        "output.pictures=[]", "output.fields_every=1 s"}));
  expect_nothing_lost(done);
  const std::vector<double>&stroke = done.of("cutter.stroke"), &x = done.of("cutter.force_x"),
        &y = done.of("cutter.force_y");
  Force mean;
  int rows = 0;
  for (std::size_t r = 0; r < stroke.size(); ++r)
    if (stroke[r] > 10e-6) {
      mean.cutting += x[r];
      mean.side += y[r];
      ++rows;
    }
  return {mean.cutting / rows, mean.side / rows};
}

/// The clouds of the two leaning slices are not mirror images: 0.5% were measured.
TEST(ObliqueCutting, mirrored_inclination_mirrors_the_side_force_which_grows_with_it) {
  const Force left = cut_at("-15 deg"), right = cut_at("15 deg"), more = cut_at("30 deg");
  EXPECT_LT(right.side, 0.0); // the far end of the edge is ahead: its normal leans to -y
  EXPECT_NEAR(left.side, -right.side, 0.02 * left.side);
  EXPECT_NEAR(left.cutting, right.cutting, 0.02 * right.cutting);
  EXPECT_LT(more.side, 1.5 * right.side);
}

/// A tool without friction presses along the normal of its edge only.
TEST(ObliqueCutting, nothing_acts_along_an_edge_without_friction) {
  const double lean = std::numbers::pi / 6;
  const auto along_edge = [&](const Force& force) {
    return force.cutting * std::sin(lean) + force.side * std::cos(lean);
  };
  const Force smooth = cut_at("30 deg", "0.0");
  EXPECT_LT(std::abs(along_edge(smooth)), 1e-6 * smooth.cutting);
  EXPECT_GT(along_edge(cut_at("30 deg")), 0.05 * smooth.cutting);
}

} // namespace
} // namespace cnem::testing
