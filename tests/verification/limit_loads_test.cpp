// Limit loads of perfectly plastic metal against slip-line solutions.
#include "tests/finished_run.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr double k = 10e6 / std::numbers::sqrt3; ///< Pa, yield stress in shear of both cases
constexpr double spacing = 0.0625e-3;            ///< m, of both where the metal flows

/// A case of cases/verification, until its load no longer rises.
FinishedRun loaded(const std::string& file, const std::vector<std::string>& changes) {
  std::vector<std::string> overrides{"time.end=24 us", "output.pictures=[]"};
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  FinishedRun done =
      finish(input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/" + file, overrides));
  EXPECT_LT(done.status.energy_residual, 1e-4);
  return done;
}

/// A load over Prandtl's, (2 + π) k on half of the width: the mean over the last sixth.
double over_prandtl(const std::vector<double>& load, double half_width) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t row = load.size() - load.size() / 6; row < load.size(); ++row, ++rows) sum -= load[row];
  return sum / static_cast<double>(rows) / ((2.0 + std::numbers::pi) * k * half_width);
}

/// The punch, its corner `beyond` spacings past the node at 1 mm.
double punch(const std::string& file, double beyond, std::vector<std::string> changes = {}) {
  const double half_width = 1e-3 + beyond * spacing;
  changes.push_back(fmt::format("tools.punch.rectangle.to={:.12g} 2 mm", 1e3 * half_width));
  const FinishedRun done = loaded("prandtl_punch/" + file, changes);
  EXPECT_LT(done.of("energy.contact_recovery").back() + done.of("energy.contact_impact").back(),
            3e-3 * done.of("energy.tool_work").back());
  return over_prandtl(done.of("punch.force_y"), half_width);
}

double notches(const std::vector<std::string>& changes) {
  return over_prandtl(loaded("double_notch/case.toml", changes).of("support.ligament.force_y"), 1e-3);
}

TEST(PrandtlPunch, bears_its_limit_load_wherever_its_corner_falls_between_nodes) {
  for (const double beyond : {0.0, 0.25, 0.5, 0.75, 0.9})
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
