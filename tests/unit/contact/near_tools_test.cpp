// What is listed as near tools, and that nothing depends on when it was.
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// A block on a die under a punch with radii that comes down on it and goes along it.
Masses rubbed_block(double radius, bool equal_areas) {
  Masses scene = block(9, 5, 0.1, {0.0, 0.0}, 60.0, 2.0);
  Tool<2> punch = tool(rounded_box({-0.5, 0.42}, {0.43, 2.0}, radius), {0.2, -0.1}, 0.2);
  punch.equal_areas = equal_areas;
  scene.start({tool(box({-1, -1}, {3, 0}), {0, 0}, 0.2), punch});
  return scene;
}

void expect_same_results(Masses seldom, Masses always) {
  for (int i = 0; i < 3000; ++i) {
    seldom.step(5e-4);
    always.contact->set_boundary(always.facets, always.mass.size(), {});
    always.step(5e-4);
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(seldom.x[k], always.x[k]) << "step " << i;
      ASSERT_EQ(seldom.v[k], always.v[k]) << "step " << i;
    }
  }
  EXPECT_GT(seldom.contact->results()[1].total.friction, 0.0);
  EXPECT_LT(seldom.contact->near().listings(), 300);
  EXPECT_GE(always.contact->near().listings(), 3000);
}

} // namespace

TEST(NearTools, results_do_not_depend_on_when_they_are_listed) {
  expect_same_results(rubbed_block(0.02, false), rubbed_block(0.02, false));
  expect_same_results(rubbed_block(0.3, true), rubbed_block(0.3, true));
}

TEST(NearTools, lists_the_nodes_and_facets_at_tools_alone) {
  Masses scene = block(21, 11, 0.1, {0.0, 0.0}, 60.0);
  scene.start({tool(box({0.5, 1.0}, {0.93, 2.0}), {0, -0.1})});
  scene.step(1e-4);
  const NearTools<2>& near = scene.contact->near();
  ASSERT_EQ(near.nodes(0_tool).size(), 5U) << "x = 0.5 to 0.9 on the upper side";
  for (const BoundaryNodeIndex b : near.nodes(0_tool))
    EXPECT_NEAR(scene.position(scene.contact->boundary_nodes()[b]).y(), 1.0, 1e-4);
  EXPECT_LE(near.at_ridges(0_tool).size(), 10U) << "of 60";
  EXPECT_GE(near.at_ridges(0_tool).size(), 3U);
}
