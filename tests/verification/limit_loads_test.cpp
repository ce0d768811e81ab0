// Limit loads of perfectly plastic metal against slip-line solutions.
#include "tests/finished_run.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr double spacing = 0.0625e-3; ///< m, of the case at the surface

/// The load of Prandtl's punch over the exact one, (2 + π) k per area, where it no longer rises: the mean
/// over the last sixth. The corner is `beyond` spacings past the node at 1 mm.
double prandtl(double beyond, const std::vector<std::string>& changes = {}) {
  const double half_width = 1e-3 + beyond * spacing, k = 100e6 / std::numbers::sqrt3;
  std::vector<std::string> overrides{fmt::format("tools.punch.rectangle.to={:.12g} 2 mm", 1e3 * half_width),
                                     "time.end=24 us", "output.pictures=[]"};
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  const FinishedRun done = finish(input::read_case(
      std::string(CNEM_SOURCE_DIR) + "/cases/verification/prandtl_punch/case.toml", overrides));
  EXPECT_LT(done.status.energy_residual, 1e-4);
  EXPECT_LT(done.of("energy.contact_recovery").back() + done.of("energy.contact_impact").back(),
            3e-3 * done.of("energy.tool_work").back());
  const std::vector<double>& force = done.of("punch.force_y");
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t row = force.size() - force.size() / 6; row < force.size(); ++row, ++rows)
    sum -= force[row];
  return sum / static_cast<double>(rows) / ((2.0 + std::numbers::pi) * k * half_width);
}

TEST(PrandtlPunch, bears_the_same_wherever_its_corner_falls_between_nodes) {
  for (const double beyond : {0.0, 0.25, 0.5, 0.75, 1.0})
    EXPECT_NEAR(prandtl(beyond), 1.026, 0.007) << beyond; // as if it reached to the next node: 1.024 to 1.08
}

TEST(PrandtlPunch, bears_less_without_the_edge_defect) {
  EXPECT_NEAR(prandtl(0.0, {"method.stabilisation=0"}), 1.010, 0.006);
}

} // namespace
} // namespace cnem::testing
