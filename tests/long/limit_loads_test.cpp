// How the limit load of a punch depends on where its corner falls, and on cells.
#include "tests/limit_loads.hpp"

namespace cnem::testing {
namespace {

using namespace limit_loads;

TEST(PrandtlPunch, bears_its_limit_load_wherever_else_its_corner_falls_between_nodes) {
  for (const double beyond : {0.25, 0.75, 0.9})
    EXPECT_NEAR(punch("case.toml", beyond), 1.002, 0.004) << beyond;
}

TEST(PrandtlPunch, bears_nearly_the_same_wherever_its_corner_falls_in_coarse_cells) {
  for (const double beyond : {0.0, 0.25, 0.5, 0.75, 1.0}) // as if it reached to the next node: 1.018 to 1.08
    EXPECT_NEAR(punch("uniform.toml", beyond), 1.022, 0.007) << beyond;
}

TEST(PrandtlPunch, feels_the_edge_defect_in_coarse_cells_of_an_old_reference_alone) {
  const std::vector<std::string> off{"method.stabilisation=0"}, coarse{"adapt.tool_spacing=0.0625 mm"};
  EXPECT_NEAR(punch("uniform.toml", 0.0, off), 1.004, 0.004);
  EXPECT_NEAR(punch("case.toml", 0.0, coarse), 1.008, 0.004);
  EXPECT_NEAR(punch("case.toml", 0.0, off), punch("case.toml", 0.0), 0.003);
}

} // namespace
} // namespace cnem::testing
