// Which nodes flow, and for how long others have not.
#include "adapt/plane/flow.hpp"
#include "tests/clouds.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

/// A strip whose left end can be made to flow.
struct Strip {
  Cloud<2> cloud;
  Structure structure;
  PointState<2> point;
  Flow flow;

  Strip() {
    testing::add_loop(cloud, {{0, 0}, {2, 0}, {2, 0.5}, {0, 0.5}}, 0.25);
    structure = build_structure(cloud);
    point.table.rest(cloud.position.size());
    flow = Flow(cloud.position.size());
  }
  bool left(std::size_t i) const { return cloud.position[as<NodeIndex>(i)].x() < 0.6; }
  /// Rates (1/s) on the left and on the right at a time (s).
  void look(double on_the_left, double on_the_right, double time) {
    for (std::size_t i = 0; i < point.size(); ++i) {
      point.plastic_rate[i] = left(i) ? on_the_left : on_the_right;
      point.equivalent_stress[i] = 4e8;
    }
    flow.look(point, structure, time);
  }
  void expect(bool left_rests, bool right_rests) const {
    for (std::size_t i = 0; i < point.size(); ++i)
      EXPECT_EQ(flow.rests(i), left(i) ? left_rests : right_rests);
  }
};

TEST(Flow, rests_where_nothing_has_flowed) {
  Strip strip;
  strip.expect(true, true);
  strip.look(0.0, 0.0, 1e-6);
  strip.expect(true, true);
}

TEST(Flow, is_where_the_work_is_done) {
  Strip strip;
  strip.look(1e5, 1e3, 1e-6);
  strip.expect(false, true);
}

TEST(Flow, is_told_from_creeping_at_any_speed) {
  for (const double speed : {1e-6, 1.0, 1e6}) {
    Strip strip;
    strip.look(1e5 * speed, 0.04e5 * speed, 1.0 / speed);
    strip.expect(false, true);
    strip.look(1e5 * speed, 0.06e5 * speed, 2.0 / speed);
    strip.expect(false, false);
  }
}

TEST(Flow, has_ceased_after_half_a_strain_of_what_flows) {
  Strip strip;
  strip.look(1e5, 0.0, 1e-6);
  strip.look(0.0, 1e5, 3.5e-6);
  strip.expect(false, false);
  strip.look(0.0, 1e5, 5.5e-6);
  strip.expect(false, false);
  strip.look(0.0, 1e5, 6.5e-6);
  strip.expect(true, false);
}

TEST(Flow, waits_while_nothing_flows) {
  Strip strip;
  strip.look(1e5, 0.0, 1e-6);
  strip.look(0.0, 0.0, 1.0);
  strip.expect(false, true);
}

} // namespace
} // namespace cnem::adapt
