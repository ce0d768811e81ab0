// Limit loads of perfectly plastic metal.
#include "tests/limit_loads.hpp"

namespace cnem::testing {
namespace {

using namespace limit_loads;

TEST(PrandtlPunch, bears_its_limit_load_wherever_its_corner_falls_between_nodes) {
  for (const double beyond : {0.0, 0.5}) // more of them in tests/long
    EXPECT_NEAR(punch("case.toml", beyond), 1.002, 0.004) << beyond;
}

TEST(DoubleNotch, bears_its_limit_load) {
  EXPECT_NEAR(notches({}), 0.998, 0.004);
  EXPECT_NEAR(notches({"cloud.refine.flow.spacing=0.25 mm", "cloud.refine.tip.spacing=0.0625 mm"}), 1.001,
              0.005);
}

TEST(DoubleNotch, bears_more_by_a_part_of_the_spacing_at_its_tip) {
  for (const double h : {0.25, 0.125, 0.0625}) { // mm
    const std::string value = fmt::format("spacing={} mm", h);
    EXPECT_NEAR(notches({"cloud.refine.flow." + value, "cloud.refine.tip." + value}), 1.0 + 0.13 * h,
                0.05 * h)
        << h;
  }
}

} // namespace
} // namespace cnem::testing
