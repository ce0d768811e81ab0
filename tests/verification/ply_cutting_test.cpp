// cases/composites/gfrp on coarse cells: the first chip of a ply, at several angles of its fibres.
#include "tests/finished_run.hpp"

#include <string>

namespace cnem::testing {
namespace {

FinishedRun ply_cut_at(const std::string& angle, const std::string& functions = "sibson") {
  const FinishedRun done =
      finish(input::read_case(CNEM_SOURCE_DIR "/cases/composites/gfrp/case.toml",
                              {"let.theta=" + angle, "let.spacing=40 um", "time.end=30 us",
                               "method.functions=" + functions, "output.pictures=[]"}));
  EXPECT_LT(done.status.energy_residual, 1e-3);
  EXPECT_EQ(done.metric("cutting.chip_completed"), 1.0) << angle;
  return done;
}

/// 1.66 here, 1.75 on the cells of the case, 1.77 measured in paper 000.
TEST(PlyCutting, takes_more_force_the_more_the_fibres_stand_across_the_cut) {
  const double low = ply_cut_at("30 deg").metric("cutting.Fc"),
               high = ply_cut_at("75 deg").metric("cutting.Fc");
  EXPECT_GT(high, 1.3 * low);
  EXPECT_LT(high, 2.3 * low);
}

TEST(PlyCutting, functions_of_both_kinds_take_the_same_force) {
  const double sibson = ply_cut_at("45 deg").metric("cutting.Fc"),
               mls = ply_cut_at("45 deg", "mls").metric("cutting.Fc");
  EXPECT_NEAR(mls, sibson, 0.02 * sibson);
}

} // namespace
} // namespace cnem::testing
