// cases/three_dimensions/blanking_slug on a coarse cloud: it does not matter how much of the blank is
// modelled.
#include "input/case_reader.hpp"
#include "tests/finished_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

/// Mean force of the punch from 5 to 25 us, N; part of a whole blank.
double mean_punch_force(const std::string& part, const std::string& planes) {
  std::vector<std::string> changes{"domain.block.part=" + part,
                                   "boundary.symmetry.pieces=" + planes,
                                   "time.end=25 us",
                                   "cloud.spacing=0.25 mm",
                                   "output.pictures=[]",
                                   "report.blanking.sections=1"};
  for (const char* ring : {"lower", "middle", "upper"})
    changes.push_back(std::string("cloud.refine.") + ring + ".spacing=0.25 mm");
  const FinishedRun done =
      finish(input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/blanking_slug/case.toml", changes));
  EXPECT_LT(done.status.energy_residual, 1e-3);
  return done.mean("punch.force_z", 5e-6, 25e-6);
}

/// Clouds of their own: measured 0.3% apart.
TEST(BlankingSlug, half_a_blank_takes_twice_the_force_of_a_quarter) {
  const double quarter = mean_punch_force("quarter", R"(["x-", "y-"])"),
               half = mean_punch_force("half", R"(["y-"])");
  EXPECT_LT(quarter, -1000.0);
  EXPECT_NEAR(half, 2.0 * quarter, 0.02 * std::abs(half));
}

} // namespace
} // namespace cnem::testing
