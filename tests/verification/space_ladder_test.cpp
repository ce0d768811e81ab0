// Cases in space whose results are known from the plane, from bodies of revolution and from the literature
// (cases/three_dimensions/*/expected.md), on coarse clouds.
#include "core/index.hpp"
#include "tests/finished_run.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

using Texts = std::vector<std::string>;

/// A case of cases/three_dimensions, run to its end.
FinishedRun run(const std::string& name, Texts overrides) {
  for (const char* quiet : {"output.pictures=[]", "output.fields_every=1 s"}) overrides.emplace_back(quiet);
  return finish(input::read_case(
      std::string(CNEM_SOURCE_DIR) + "/cases/three_dimensions/" + name + "/case.toml", overrides));
}

/// Simo and Armero: 6.97 to 7.09 mm. Median cells are softer by 1 to 2% on this cloud.
TEST(SpaceLadder, cooks_membrane_between_planes) {
  const Texts coarse{"cloud.spacing=3 mm", "domain.extrude.to=3 mm", "boundary.load.traction.y.ramp=60 ms",
                     "time.end=66 ms", "output.history_every=1 ms"};
  Texts voronoi = coarse;
  for (const char* key : {"method.cells=voronoi", "method.functions=laplace", "method.lagrangian=total"})
    voronoi.emplace_back(key);
  for (const auto& [overrides, most] : {std::pair(coarse, 7.19e-3), {voronoi, 7.09e-3}}) {
    const FinishedRun done = run("cook", overrides);
    const double tip = done.of("probe.tip.displacement_y").back();
    EXPECT_GT(tip, 6.97e-3);
    EXPECT_LT(tip, most);
    EXPECT_NEAR(done.of("probe.tip_above.displacement_y").back(), tip, 1e-3 * tip) << "it twists";
    EXPECT_LT(done.status.energy_residual, 1e-4);
  }
}

/// 77 to 78 kN and a neck of 2.2 to 2.4 mm, for which the cloud has to follow: nodes that only go with the
/// metal are five times as far apart along the axis there, and the neck stays near 3 mm. How round it is
/// differs between clouds, and between the roundings of one: nine have 0.3 to 7.4%, 3.7% in the mean square.
TEST(SpaceLadder, round_bar_necks) {
  double squares = 0.0;
  const Texts spacings{"0.79 mm", "0.8 mm", "0.805 mm", "0.82 mm", "0.83 mm"};
  for (const std::string& spacing : spacings) {
    SCOPED_TRACE(spacing);
    const FinishedRun done = run("necking", {"cloud.refine.neck.spacing=" + spacing});
    const std::vector<double>&force = done.of("support.grip.force_z"),
          &way = done.of("probe.grip.displacement_z");
    const std::size_t most = index_of(std::max_element(force.begin(), force.end()) - force.begin());
    EXPECT_GT(4.0 * force[most], 77e3);
    EXPECT_LT(4.0 * force[most], 78e3);
    EXPECT_NEAR(way[most], 2.86e-3, 0.15e-3); // as the body of revolution
    const double x = 6.298e-3 + done.of("probe.neck_x.displacement_x").back(),
                 y = 6.298e-3 + done.of("probe.neck_y.displacement_y").back();
    EXPECT_NEAR(0.5 * (x + y), 2.3e-3, 0.1e-3);
    squares += std::pow(x / y - 1.0, 2);
    expect_nothing_lost(done);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(spacings.size())), 0.07) << "out of round";
}

/// The reference of TaylorBar.stainless_steel_with_heat.
TEST(SpaceLadder, taylor_bar_of_stainless_steel) {
  const FinishedRun done = run("taylor_304l", {"cloud.spacing=0.8 mm"});
  EXPECT_NEAR(32.4e-3 + done.of("probe.free_end.displacement_z").back(), 27.786e-3, 0.002 * 27.786e-3);
  for (const char* foot : {"probe.foot.displacement_x", "probe.foot_y.displacement_y"})
    EXPECT_NEAR(3.2e-3 + done.of(foot).back(), 4.2065e-3, 0.01 * 4.2065e-3);
  EXPECT_NEAR(done.of("probe.centre.plastic_strain").back(), 0.630, 0.1 * 0.630);
  EXPECT_NEAR(done.of("probe.centre.temperature").back() - 296.0, 505.7 - 296.0, 0.1 * (505.7 - 296.0));
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

} // namespace
} // namespace cnem::testing
