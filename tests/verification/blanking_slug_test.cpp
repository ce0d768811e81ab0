// Round blanks in space (cases/three_dimensions/blanking_slug, blanking_round): whole_blank runs beside the
// axisymmetric ones when CNEM_WHOLE_RUNS is set; on a coarse cloud that it does not matter how much of the
// blank is modelled.
#include "input/case_reader.hpp"
#include "tests/finished_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

/// Mean force of the punch from 5 to 25 us, N; part of a whole_blank blank.
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

FinishedRun whole_blank(const std::string& name) {
  return finish(input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/" + name, {"output.pictures=[]"}));
}

TEST(BlankingSlug, comes_off_and_keeps_its_balances) {
  if (!std::getenv("CNEM_WHOLE_RUNS")) GTEST_SKIP() << "minutes";
  const FinishedRun space = whole_blank("blanking_slug/case.toml"),
                    round = whole_blank("blanking_slug/axisymmetric.toml");
  EXPECT_EQ(space.metric("adapt.cuts"), 1.0);
  EXPECT_EQ(space.metric("blanking.slug.parted"), 1.0);
  EXPECT_EQ(space.metric("retries"), 0.0);
  EXPECT_LT(space.status.energy_residual, 3e-3);
  for (const char* kept : {"mass_drift", "adapt.mass_error", "adapt.momentum_error"})
    EXPECT_LT(std::abs(space.metric(kept)), 1e-12) << kept;
  EXPECT_LT(std::abs(space.metric("enclosed_volume_drift")), 0.01); // 0.005 is wanted
  const double expected = round.mean("punch.force_y", 5e-6, 40e-6);
  EXPECT_NEAR(4.0 * space.mean("punch.force_z", 5e-6, 40e-6), expected, 0.1 * std::abs(expected));
}

TEST(BlankingRound, takes_the_force_of_the_axisymmetric_run) {
  if (!std::getenv("CNEM_WHOLE_RUNS")) GTEST_SKIP() << "half a minute";
  const FinishedRun space = whole_blank("blanking_round/case.toml"),
                    round = whole_blank("blanking_round/axisymmetric.toml");
  for (const double t : {1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 11.5}) {
    const double from = (t - 0.5) * 1e-6, to = (t + 0.5) * 1e-6,
                 expected = round.mean("punch.force_y", from, to);
    EXPECT_NEAR(4.0 * space.mean("punch.force_z", from, to), expected, 0.04 * std::abs(expected)) << t;
  }
}

} // namespace
} // namespace cnem::testing
