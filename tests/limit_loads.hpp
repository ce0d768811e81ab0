#pragma once
// Limit loads of perfectly plastic metal against slip-line solutions.
#include "tests/finished_run.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::testing::limit_loads {
inline constexpr double k = 10e6 / std::numbers::sqrt3; ///< Pa, yield stress in shear of both cases
inline constexpr double spacing = 0.0625e-3;            ///< m, of both where the metal flows

/// A case of cases/verification, until its load no longer rises.
inline FinishedRun loaded(const std::string& file, const std::vector<std::string>& changes) {
  std::vector<std::string> overrides{"time.end=24 us", "output.pictures=[]"};
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  FinishedRun done =
      finish(input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/" + file, overrides));
  EXPECT_LT(done.status.energy_residual, 1e-4);
  return done;
}

/// A load over Prandtl's, (2 + π) k on half of the width: the mean over the last sixth.
inline double over_prandtl(const std::vector<double>& load, double half_width) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t row = load.size() - load.size() / 6; row < load.size(); ++row, ++rows) sum -= load[row];
  return sum / static_cast<double>(rows) / ((2.0 + std::numbers::pi) * k * half_width);
}

/// The punch, its corner `beyond` spacings past the node at 1 mm.
inline double punch(const std::string& file, double beyond, std::vector<std::string> changes = {}) {
  const double half_width = 1e-3 + beyond * spacing;
  changes.push_back(fmt::format("tools.punch.rectangle.to={:.12g} 2 mm", 1e3 * half_width));
  const FinishedRun done = loaded("prandtl_punch/" + file, changes);
  EXPECT_LT(done.of("energy.contact_recovery").back() + done.of("energy.contact_impact").back(),
            3e-3 * done.of("energy.tool_work").back());
  return over_prandtl(done.of("punch.force_y"), half_width);
}

inline double notches(const std::vector<std::string>& changes) {
  return over_prandtl(loaded("double_notch/case.toml", changes).of("support.ligament.force_y"), 1e-3);
}

} // namespace cnem::testing::limit_loads
