// Contact of masses on springs with each other: pairs, momentum, penetration that is there already.
#include "tests/unit/contact/masses.hpp"

#include <gtest/gtest.h>

namespace cnem::contact::testing {
namespace {

/// Adds the masses of another scene.
void append(Masses& scene, const Masses& other) {
  const int offset = static_cast<int>(scene.mass.size());
  for (int i = 0; i < int(other.mass.size()); ++i)
    scene.add(other.position(i), other.mass[std::size_t(i)], other.velocity(i));
  for (Masses::Spring s : other.springs) {
    s.a += offset, s.b += offset;
    scene.springs.push_back(s);
  }
  for (Facet<2> f : other.facets) {
    for (NodeIndex& node : f.node) node = as<NodeIndex>(as<int>(node) + offset);
    scene.facets.push_back(f);
  }
}

void let_bodies_touch(Masses& scene, double friction, std::vector<Tool<2>> tools = {}) {
  scene.contact = std::make_shared<RigidContact<2>>(std::move(tools), Space::plane,
                                                    BodyContactLaw{true, Coulomb{friction}});
  scene.contact->set_boundary(scene.facets, scene.mass.size(), scene.constraints);
}

double angular_momentum(const Masses& scene) {
  double sum = 0.0;
  for (int i = 0; i < int(scene.mass.size()); ++i)
    sum += scene.mass[std::size_t(i)] * cross(scene.position(i), scene.velocity(i));
  return sum;
}

TEST(Bodies, oblique_impact_keeps_both_momenta_and_balances_energy) {
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.05, 0.0, {0.5, 0.0});
  append(scene, block(4, 6, 0.21, {1.1, 0.33}, 300.0, 0.05, 0.1, {-1.0, -0.2}));
  let_bodies_touch(scene, 0.3);
  const Vec2 momentum = scene.momentum();
  const double angular = angular_momentum(scene), start = scene.kinetic();
  ContactWork work;
  bool touched = false;
  for (int n = 0; n < 4000; ++n) {
    scene.step(2e-4);
    touched = touched || scene.contact->body_result().pressing > 0.0;
  }
  work = scene.contact->body_result().total;
  EXPECT_TRUE(touched);
  EXPECT_LT((scene.momentum() - momentum).norm(), 1e-12);
  EXPECT_NEAR(angular_momentum(scene), angular, 1e-4 * angular) << "but for slip along facets within a step";
  EXPECT_NEAR(work.workpiece, work.recovery - work.friction - work.impact, 1e-12);
  EXPECT_NEAR(scene.kinetic() - start, work.workpiece + scene.applied_work, 1e-12);
  EXPECT_GT(work.friction, 0.0);
}

TEST(Bodies, a_thin_body_does_not_touch_its_own_far_side) {
  Masses scene = block(21, 2, 0.05, {0, 0}, 1.0, 0.0, 0.0, {1.0, 0.3});
  for (std::size_t i = 0; i < scene.mass.size(); ++i) scene.x[1][i] *= 0.2; // far side within the skin
  let_bodies_touch(scene, 0.0);
  scene.springs.clear();
  for (int n = 0; n < 100; ++n) scene.step(1e-3);
  EXPECT_EQ(scene.contact->body_result().total.workpiece, 0.0);
  EXPECT_EQ(scene.contact->body_result().total.recovery, 0.0);
}

// The way from a node to the corner of its own side runs along the side: there is no gap round the corner.
// The side may have nodes between, and a dent.
TEST(Bodies, a_wedge_does_not_touch_the_side_that_it_shares_a_corner_with) {
  for (const double dent : {0.0, 1e-8}) {
    Masses scene;
    const std::vector<Vec2> corner{{0, 0.5},         {1, 0.9}, {1 - dent, 0.93},
                                   {1 - dent, 0.97}, {1, 1},   {0, 1 + 1e-9}};
    const int nodes = int(corner.size());
    for (const Vec2& x : corner) scene.add(x, 1.0, {0, 0});
    scene.v[1].back() = -1e-5;
    for (int i = 0; i < nodes; ++i)
      scene.facets.push_back({{as<NodeIndex>(i), as<NodeIndex>((i + 1) % nodes)}, {}});
    let_bodies_touch(scene, 0.0);
    for (int n = 0; n < 10; ++n) scene.step(1e-3);
    ASSERT_LT(scene.position(nodes - 1).y(), 1.0);
    EXPECT_EQ(scene.contact->body_result().total.workpiece, 0.0);
    EXPECT_EQ(scene.contact->body_result().total.recovery, 0.0);
  }
}

TEST(Bodies, a_corner_that_slides_over_a_ridge_is_stopped_by_the_facet_behind_it) {
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
  const std::size_t ridge = 22;
  ASSERT_LT((scene.position(int(ridge)) - Vec2(0.5, 1.0)).norm(), 1e-12);
  scene.x[1][ridge] += 0.02;
  scene.springs.clear();
  for (double& m : scene.mass) m = 1e9;       // does not give way
  scene.add({0.47, 1.018}, 1.0, {1.0, -0.5}); // standing on its corner
  scene.add({0.57, 1.118}, 1.0, {1.0, -0.5});
  scene.add({0.37, 1.118}, 1.0, {1.0, -0.5});
  const int corner = 25;
  for (int k = 0; k < 3; ++k)
    scene.facets.push_back({{as<NodeIndex>(corner + k), as<NodeIndex>(corner + (k + 1) % 3)}, {}});
  let_bodies_touch(scene, 0.0);
  for (int n = 0; n < 50; ++n) {
    for (std::size_t i = corner; i < scene.mass.size(); ++i) scene.v[0][i] = 1.0, scene.v[1][i] = -0.5;
    scene.step(1e-3);
  }
  const Vec2 a = scene.position(int(ridge)), b = scene.position(int(ridge) + 1), x = scene.position(corner);
  ASSERT_GT(x.x(), a.x() + 0.01);
  EXPECT_GT(cross(b - a, x - a), -1e-5) << "outside of the facet that falls away";
}

TEST(Bodies, penetration_found_at_the_start_is_removed_slowly) {
  const double depth = 0.02, closing = 0.1;
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
  append(scene, block(5, 5, 0.25, {0.02, 1.0 - depth}, 400.0, 0.5, 0.0, {0, -closing}));
  let_bodies_touch(scene, 0.0);
  scene.step(1e-3);
  double fastest = 0.0;
  for (int i = 0; i < int(scene.mass.size()); ++i) fastest = std::max(fastest, scene.velocity(i).norm());
  EXPECT_LT(fastest, 2.0 * closing) << "not thrown out at depth over dt = 20 m/s";
  for (int n = 0; n < 1500; ++n) scene.step(1e-3);
  EXPECT_GT(scene.position(25).y() - scene.position(20).y(), -0.5 * depth) << "and yet it goes";
  EXPECT_GE(scene.contact->body_result().total.recovery, 0.0);
}

// Two walls at an angle of 30° push a wedge that lies in both of them along their bisector, 1/sin 15° times
// as fast as each alone: half of the speed that it gets so is twice that which pushed it.
TEST(Bodies, a_wedge_between_two_walls_is_not_pushed_out_ever_faster) {
  const double depth = 0.02, speed = 0.1, half_angle = std::numbers::pi / 12.0;
  Masses scene;
  for (const double side : {-1.0, 1.0}) {
    const Vec2 along(side * std::sin(half_angle), std::cos(half_angle)), out(side, 0.0);
    std::vector<int> nodes;
    for (const Vec2& x : {Vec2(0.0, 0.0), Vec2(out), Vec2(out + along), along})
      nodes.push_back(scene.add(x, 1e9));
    if (side < 0.0) std::reverse(nodes.begin(), nodes.end());
    scene.loop(nodes);
    scene.x[0][std::size_t(nodes[0])] += 1e-3 * side;
  }
  const double height = 0.2, half = height * std::tan(half_angle) + depth;
  const int left = scene.add({-half, height}, 1.0, {0.0, -speed});
  scene.add({half, height}, 1.0, {0.0, -speed});
  scene.add({0.0, 0.6}, 1.0, {0.0, -speed});
  scene.loop({left, left + 1, left + 2});
  scene.link(left, left + 1, 4e5, 400.0);
  append(scene, block(5, 5, 0.25, {3.0, 0.0}, 400.0, 0.5)); // at rest, as most of a workpiece
  let_bodies_touch(scene, 0.0);
  double fastest = 0.0;
  for (int n = 0; n < 1000; ++n) {
    scene.step(1e-3);
    fastest = std::max(fastest, scene.velocity(left).norm());
  }
  EXPECT_LT(fastest, 2.0 * speed);
  EXPECT_GT(scene.contact->body_result().total.recovery, 0.0);
}

TEST(Bodies, faces_that_were_bonded_keep_what_pressed_them_and_no_more) {
  const auto gap_after = [&](double depth, double pressed, double closing) {
    Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
    append(scene, block(5, 5, 0.25, {0.02, 1.0 - depth}, 400.0, 0.5, 0.0, {0, -closing}));
    let_bodies_touch(scene, 0.0);
    Bonds bonds;
    bonds.rest(scene.mass.size(), scene.facets.size());
    for (const CloudFacetIndex f : bonds.face.indices())
      bonds.face[f] = as<int>(scene.facets[index_of(f)].node[0]) < 25 ? 0 : 1;
    bonds.pressed.assign(scene.mass.size(), pressed);
    scene.contact->set_bonds(bonds);
    for (int n = 0; n < 1500; ++n) scene.step(1e-3);
    return scene.position(25).y() - scene.position(20).y();
  };
  EXPECT_NEAR(gap_after(0.02, 0.02, 0.0), -0.02, 1e-15) << "to push it out would take work";
  EXPECT_GT(gap_after(0.02, 0.0, 0.1), -0.01) << "what came to it later goes";
  EXPECT_NEAR(gap_after(0.2, 0.2, 0.0), -0.2, 1e-15);
  EXPECT_GT(gap_after(0.2, 0.2, 0.1), -0.21)
      << "faces that have been pressed deeper than pairs are looked for";
}

/// Two blocks with facets of 0.25, one of which stands on the other by this much less than nothing, all of
/// their nodes bonded, and a square of side 0.1 that stands still.
Masses bonded_blocks(double depth, const Vec2& square) {
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
  append(scene, block(5, 5, 0.25, {0, 1.0 - depth}, 400.0, 0.5));
  scene.springs.clear();
  scene.square(square, 0.1);
  let_bodies_touch(scene, 0.0);
  Bonds bonds;
  bonds.rest(scene.mass.size(), scene.facets.size());
  for (std::size_t f = 0; f < scene.facets.size(); ++f) {
    const auto a = scene.facets[f].node[0], b = scene.facets[f].node[1];
    const auto on = [&](double y) { return scene.position(a).y() == y && scene.position(b).y() == y; };
    const bool below = on(1.0) && as<int>(a) < 25;
    if (!below && !(on(1.0 - depth) && as<int>(a) < 50)) continue;
    bonds.face[f] = below ? 1 : 0;
    const double from = scene.position(a).x(), to = scene.position(b).x();
    bonds.arc[f] = {std::min(from, to), std::max(from, to)};
    for (const NodeIndex i : {a, b}) {
      bonds.bonded[i] = below ? 1 : 0;
      bonds.reach[i] = {scene.position(i).x(), scene.position(i).x()};
    }
  }
  scene.contact->set_bonds(bonds);
  return scene;
}

TEST(Bodies, bonded_nodes_do_not_meet_what_they_are_bonded_to_and_meet_all_else) {
  Masses pressed = bonded_blocks(0.02, {5.0, 5.0});
  for (int n = 0; n < 10; ++n) pressed.step(1e-3);
  EXPECT_EQ(pressed.contact->body_result().total.recovery, 0.0);
  EXPECT_EQ(pressed.momentum(), Vec2(0, 0));
  // between the faces, where a node of either is between two facets that are bonded to the other
  Masses parted = bonded_blocks(-0.11, {0.45, 1.005});
  for (int i = 25; i < 50; ++i) parted.v[1][std::size_t(i)] = -1.0;
  for (int n = 0; n < 40; ++n) parted.step(1e-3);
  const int node = 27; // in the middle of the upper face
  ASSERT_NEAR(parted.position(node).x(), 0.5, 1e-12);
  EXPECT_GT(parted.position(node).y(), parted.position(52).y() - 1e-3) << "it does not go into the square";
}

TEST(Bodies, a_sharp_tip_meets_what_neither_of_its_facets_faces) {
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
  scene.springs.clear();
  for (double& m : scene.mass) m = 1e9;
  const int tip = scene.add({0.4, 1.005}, 1.0, {0.0, -1.0}); // 11 degrees
  scene.add({0.45, 1.505}, 1.0, {0.0, -1.0});
  scene.add({0.35, 1.505}, 1.0, {0.0, -1.0});
  scene.loop({tip, tip + 1, tip + 2});
  let_bodies_touch(scene, 0.0);
  for (int n = 0; n < 50; ++n) scene.step(1e-3);
  EXPECT_GT(scene.position(tip).y(), 1.0 - 1e-5);
}

TEST(Bodies, sub_steps_are_reported_as_one_step) {
  Masses scene = block(5, 5, 0.25, {0, 0}, 400.0, 0.5);
  append(scene, block(5, 5, 0.25, {0.02, 1.01}, 400.0, 0.5, 0.1, {0.05, -0.2}));
  let_bodies_touch(scene, 0.2);
  while (scene.contact->body_result().total.friction == 0.0) scene.step(1e-3);
  ContactWork sum;
  double impulse = 0.0;
  Masses same = scene;
  same.contact = std::make_shared<RigidContact<2>>(*scene.contact);
  for (int n = 0; n < 5; ++n) {
    same.step(1e-3);
    sum += same.contact->body_result().step;
    impulse += 1e-3 * same.contact->body_result().pressing;
  }
  scene.contact->begin_sub_steps();
  for (int n = 0; n < 5; ++n) scene.step(1e-3);
  scene.contact->end_sub_steps(5e-3);
  const BodyResult<2>& result = scene.contact->body_result();
  EXPECT_GT(sum.friction, 0.0);
  EXPECT_NEAR(result.step.friction, sum.friction, 1e-12 * sum.friction);
  EXPECT_NEAR(result.step.workpiece, sum.workpiece, 1e-12);
  EXPECT_NEAR(result.step.impact, sum.impact, 1e-12);
  EXPECT_NEAR(result.pressing, impulse / 5e-3, 1e-12 * result.pressing);
}

TEST(Bodies, a_free_tool_on_a_stack_keeps_their_common_momentum) {
  Masses scene = block(5, 3, 0.25, {0, 0}, 400.0, 0.05);
  append(scene, block(6, 3, 0.2, {0, 0.51}, 400.0, 0.05));
  Tool<2> hammer = tool(box({-1, 0.92}, {2, 2}));
  hammer.drive = ToolDrive<2>{3.0, {TimeTable(0.0), TimeTable(0.0)}, {0.0, -0.5}};
  let_bodies_touch(scene, 0.0, {hammer});
  bool pressed = false;
  for (int n = 0; n < 2000; ++n) {
    scene.step(2e-4);
    const double hit = scene.contact->results()[0].force.norm();
    pressed = pressed || (hit > 0.0 && scene.contact->body_result().pressing > 0.0);
  }
  EXPECT_TRUE(pressed) << "both in one step";
  const Vec2 momentum = scene.momentum() + 3.0 * scene.contact->velocity(0, scene.time);
  EXPECT_LT((momentum - Vec2(0.0, -1.5)).norm(), 1e-12);
}

TEST(Bodies, a_stack_between_two_tools_shares_one_force) {
  Masses scene = block(5, 3, 0.25, {0, 0}, 400.0, 1.0);
  append(scene, block(6, 3, 0.2, {0, 0.5}, 400.0, 1.0));
  let_bodies_touch(scene, 0.0, {tool(box({-1, -1}, {2, 0})), tool(box({-1, 0.9}, {2, 2}), {0, -0.05})});
  for (int n = 0; n < 1000; ++n) scene.step(1e-3);
  const double below = scene.contact->results()[0].force.y(), above = -scene.contact->results()[1].force.y();
  EXPECT_GT(above, 1.0);
  EXPECT_NEAR(below, above, 0.05 * above);
  EXPECT_NEAR(scene.contact->body_result().pressing, above, 0.05 * above);
  EXPECT_LT(scene.contact->bodies().listings(), 20);
}

} // namespace
} // namespace cnem::contact::testing
