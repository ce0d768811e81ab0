// Metal that stretches around a blunt edge without friction: what its chords cost.
#include "tests/finished_run.hpp"

namespace cnem::testing {
namespace {

/// Recovery and impact of contact over the work of the tool, one feed of cut.
double lost_at_edge(const std::vector<std::string>& changes) {
  std::vector<std::string> overrides{"cutting.edge_radius=40 um", "cutting.friction.coefficient=0",
                                     "cutting.length=0.4 mm", "output.pictures=[]"};
  overrides.insert(overrides.end(), changes.begin(), changes.end());
  const FinishedRun done = finish(
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/cutting/a2024_800/case.toml", overrides));
  expect_nothing_lost(done);
  return (done.of("energy.contact_recovery").back() + done.of("energy.contact_impact").back()) /
         done.of("energy.tool_work").back();
}

/// The spacing that [cutting] makes, and twice that.
TEST(CuttingEdge, pushes_out_chords_for_little_work_that_falls_with_the_square_of_their_length) {
  const double fine = lost_at_edge({}), coarse = lost_at_edge({"adapt.tool_spacing=8.433 um"});
  EXPECT_LT(fine, 5e-3);
  EXPECT_GT(coarse, 3.0 * fine);
  EXPECT_LT(coarse, 6.0 * fine);
}

} // namespace
} // namespace cnem::testing
