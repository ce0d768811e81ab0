// Edge forces in charts of stability: left out unless asked for, and told where they matter.
#include "tests/finished_run.hpp"

#include <algorithm>

namespace cnem::testing {
namespace {

FinishedRun lobes(const std::string& side, const std::string& edge_forces, const std::string& Kre) {
  return finish(
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/end_mill_forces/case.toml",
                       {"analysis.type=stability", "milling.side=" + side, "milling.axial_depth=2 mm",
                        "milling.speed=7000 rpm", "stability.edge_forces=" + edge_forces,
                        "cutting.forces.Kre=" + Kre, "cutting.forces.Kte=" + Kre, "cutting.forces.Kae=0 N/m",
                        "modes.y.frequency=764 Hz", "modes.y.damping=0.03", "modes.y.stiffness=8 N/um",
                        "modes.y.direction=0 1 0", "stability.speeds=2", "stability.depths=2"}));
}

bool told(const FinishedRun& run) {
  return std::any_of(run.status.warnings.begin(), run.status.warnings.end(), [](const std::string& warning) {
    return warning.find("edge forces change the limit") != std::string::npos;
  });
}

} // namespace

TEST(EdgeForcesInLobes, AreToldWhereTheyChangeTheLimit) {
  const FinishedRun without = lobes("down", "false", "27 N/mm"), with = lobes("down", "true", "27 N/mm");
  EXPECT_TRUE(told(without));
  EXPECT_FALSE(told(with));
  EXPECT_LT(with.metric("stability.depth_limit"), 0.95 * without.metric("stability.depth_limit"));
  EXPECT_NEAR(without.metric("stability.depth_limit_with_edge_forces") / with.metric("stability.depth_limit"),
              1.0, 1e-6);
  const FinishedRun sharp = lobes("down", "false", "0 N/mm");
  EXPECT_FALSE(told(sharp));
  EXPECT_EQ(sharp.metric("stability.depth_limit"), without.metric("stability.depth_limit"));
  EXPECT_FALSE(sharp.status.metric("stability.depth_limit_with_edge_forces"));
}

} // namespace cnem::testing
