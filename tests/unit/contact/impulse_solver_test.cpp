// Impulses of contacts that feel each other, against sweeps of projected Gauss-Seidel that went on until they
// stood still.
#include "tests/unit/contact/impulse_scenes.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// Nodes and the facets between them, as under a rounded edge.
Scene<2> chain(int length, Law law, double coefficient, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scene<2> scene;
  scene.tools.resize(1);
  for (int i = 0; i < length; ++i) {
    Reaction<2> node;
    node.inverse = Mat2::Identity() / (0.5 + any(random));
    node.velocity = Vec2(any(random) - 0.3, -any(random));
    scene.nodes.push_back(node);
  }
  const auto normal = [&](double at) { return Vec2(std::sin(0.05 * at), std::cos(0.05 * at)); };
  for (int i = 0; i < length; ++i) {
    const auto b = as<BoundaryNodeIndex>(i), next = as<BoundaryNodeIndex>(i + 1);
    if (any(random) < 0.8)
      scene.contacts.push_back(on_tool<2>(normal(i), 1e-3 * (any(random) - 0.2), {{b, 1.0}}));
    if (i + 1 == length) continue;
    const double s = any(random);
    scene.contacts.push_back(
        on_tool<2>(normal(i + 0.5), 1e-3 * (any(random) - 0.2), {{b, 1.0 - s}, {next, s}}));
  }
  set_law(scene, law, coefficient, random);
  return scene;
}

} // namespace

TEST(ImpulseSolver, agrees_with_sweeps_that_have_come_to_rest) {
  std::mt19937 random(7);
  for (const Law law : {Law::none, Law::coulomb, Law::tresca, Law::smooth})
    for (const int length : {1, 2, 5, 40})
      for (int trial = 0; trial < 10; ++trial) {
        Scene<2> scene = chain(length, law, 0.3, random), swept = scene;
        const double depth = scene.deepest();
        ASSERT_TRUE(sweep_until_rest(swept));
        ImpulseSolver<2>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 100);
        expect_solved(scene, depth);
        EXPECT_LT(lost_momentum(scene).norm(), 1e-13 * length);
        EXPECT_LE(difference(scene, swept), 1e-7)
            << "law " << int(law) << ", " << length << " nodes, " << trial;
      }
}

TEST(ImpulseSolver, needs_few_sweeps) {
  std::mt19937 random(11);
  int few = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    Scene<2> scene = chain(20, Law::coulomb, 0.2, random), solved = scene;
    ImpulseSolver<2>().solve(solved.contacts, solved.nodes, solved.tools, dt, 1e-18, 1000);
    ImpulseSolver<2>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 3);
    few += difference(scene, solved) < 1e-7;
  }
  EXPECT_GE(few, trials * 8 / 10);
}

TEST(ImpulseSolver, redundant_contacts_bear_what_one_would) {
  Scene<2> one = resting_node<2>(), both = one;
  one.contacts = {on_tool<2>({0, 1}, 1e-3, {{0_boundary, 1.0}})};
  both.contacts = {one.contacts[0], one.contacts[0], on_tool<2>({0.6, 0.8}, 1e-3, {{0_boundary, 1.0}})};
  one.contacts.push_back(both.contacts[2]);
  for (Scene<2>* scene : {&one, &both})
    ImpulseSolver<2>().solve(scene->contacts, scene->nodes, scene->tools, dt, 1e-18, 100);
  EXPECT_LT(difference(one, both), 1e-9);
  EXPECT_LT((both.nodes[0_boundary].change * dt - Vec2(1e-3 / 3.0, 1e-3)).norm(), 1e-12);
}

TEST(ImpulseSolver, a_node_without_room_is_not_thrown) {
  for (const double wedge : {0.0, 1e-9, 1e-3}) { // the tools' faces, all but parallel
    Scene<2> scene = resting_node<2>();
    scene.contacts = {on_tool<2>({0, 1}, 1e-3, {{0_boundary, 1.0}}),
                      on_tool<2>({std::sin(wedge), -std::cos(wedge)}, 1e-3, {{0_boundary, 1.0}})};
    ImpulseSolver<2>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 100);
    EXPECT_LT(scene.nodes[0_boundary].change.norm() * dt, 2e-3) << wedge;
  }
}

// A face in a plane of symmetry that rounding has tilted presses along what its nodes are free to do.
TEST(ImpulseSolver, what_is_held_but_for_rounding_takes_no_impulse) {
  for (const auto& [tilt, throws] : {std::pair(2e-5, false), std::pair(0.01, true)}) {
    Scene<2> scene;
    scene.tools.resize(1);
    Reaction<2> node;
    node.inverse = Vec2(1, 0).asDiagonal(); // held in y
    scene.nodes.push_back(node);
    scene.contacts.push_back(on_tool<2>(Vec2(tilt, 1).normalized(), 1e-9, {{0_boundary, 1.0}}));
    ImpulseSolver<2>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 100);
    EXPECT_EQ(scene.contacts[0].pressing > 0.0, throws) << tilt;
  }
}
