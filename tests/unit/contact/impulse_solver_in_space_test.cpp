// Impulses in space of contacts that feel each other: of nodes, edges and facets of a sheet on a curved tool.
#include "tests/unit/contact/impulse_scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr double rounding = 1e-16; // m, where contacts are a thousandth of a metre deep

/// A square of side² nodes of some `mass` (kg), those of its first row held across the row (a plane of
/// symmetry off which faces are tilted by rounding).
Scene<3> sheet(int side, Law law, double coefficient, std::mt19937& random, double mass = 1.0) {
  constexpr double tilt = 1e-12;
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scene<3> scene;
  scene.tools.resize(1);
  for (int i = 0; i < side * side; ++i) {
    Reaction<3> node;
    node.inverse = Mat<3>::Identity() / (mass * (0.5 + any(random)));
    if (i < side) node.inverse(1, 1) = 0.0;
    node.velocity = Vec3(any(random) - 0.3, i < side ? 0.0 : any(random) - 0.5, -any(random));
    scene.nodes.push_back(node);
  }
  const auto at = [&](int x, int y) { return as<BoundaryNodeIndex>(x + side * y); };
  const auto normal = [](double x, double y) { return Vec3(0.1 * x, 0.1 * y + tilt, 1.0).normalized(); };
  const auto depth = [&] { return 1e-3 * (any(random) - 0.3); };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double s = any(random), t = (1.0 - s) * any(random);
      if (any(random) < 0.8) scene.contacts.push_back(on_tool<3>(normal(x, y), depth(), {{at(x, y), 1.0}}));
      if (x + 1 < side && any(random) < 0.3)
        scene.contacts.push_back(
            on_tool<3>(normal(x + s, y), depth(), {{at(x, y), 1.0 - s}, {at(x + 1, y), s}}));
      if (x + 1 < side && y + 1 < side && any(random) < 0.3)
        scene.contacts.push_back(on_tool<3>(normal(x + s, y + t), depth(),
                                            {{at(x, y), 1.0 - s - t}, {at(x + 1, y), s}, {at(x, y + 1), t}}));
    }
  set_law(scene, law, coefficient, random);
  return scene;
}

} // namespace

TEST(ImpulseSolverInSpace, agrees_with_sweeps_that_have_come_to_rest) {
  std::mt19937 random(5);
  int at_rest = 0;
  for (const Law law : {Law::none, Law::coulomb, Law::tresca, Law::smooth})
    for (const int side : {1, 2, 3})
      for (int trial = 0; trial < 10; ++trial) {
        Scene<3> scene = sheet(side, law, 0.2, random), swept = scene;
        const double depth = scene.deepest();
        const bool rests = sweep_until_rest(swept, rounding);
        ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 1000);
        expect_solved(scene, depth);
        if (!rests) continue; // solved, where sweeps alone do not get there
        ++at_rest;
        EXPECT_LE(difference(scene, swept), 1e-6) << "law " << int(law) << ", " << side << ", " << trial;
      }
  EXPECT_GE(at_rest, 110); // of 120
}

TEST(ImpulseSolverInSpace, needs_few_sweeps) {
  std::mt19937 random(11);
  int few = 0, few_alone = 0, at_rest = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    Scene<3> scene = sheet(3, Law::coulomb, 0.2, random, trial % 2 == 0 ? 1.0 : 1e-9), solved = scene,
             swept = scene;
    if (!sweep_until_rest(solved, rounding)) continue;
    ++at_rest;
    ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 3);
    few += difference(scene, solved) < 1e-6;
    for (int n = 0; n < 3; ++n) sweep(swept);
    few_alone += difference(swept, solved) < 1e-6;
  }
  EXPECT_GE(at_rest, trials * 9 / 10);
  EXPECT_LE(few_alone, at_rest * 4 / 10);
  EXPECT_GE(few, at_rest * 9 / 10);
}

// Images of a contact over a period: any of them may bear the load.
TEST(ImpulseSolverInSpace, redundant_contacts_bear_what_one_would) {
  std::mt19937 random(3);
  Scene<3> one = sheet(3, Law::coulomb, 0.2, random), twice = one;
  const double depth = one.deepest();
  ImpulseSolver<3>().solve(one.contacts, one.nodes, one.tools, dt, 1e-18, 1000);
  twice.contacts.insert(twice.contacts.end(), twice.contacts.begin(), twice.contacts.end());
  ImpulseSolver<3>().solve(twice.contacts, twice.nodes, twice.tools, dt, 1e-18, 3);
  expect_solved(twice, depth);
  EXPECT_LE(difference(one, twice), 1e-6);
}

// What is left to a later pass of a step is rounding: measured by that it would be swept on and on.
TEST(ImpulseSolverInSpace, later_solutions_measure_by_the_depth_of_the_first) {
  std::mt19937 random(9);
  Scene<3> scene = sheet(3, Law::coulomb, 0.2, random);
  const double depth = ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 1000);
  EXPECT_GT(depth, 1e-4);
  const Scene<3> first = scene;
  EXPECT_EQ(ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-30, 1000, depth),
            depth);
  EXPECT_LE(difference(scene, first), 1e-8);
}

// No impulse stops slip along what is held; friction is shared with the slip across it, as sweeps do.
TEST(ImpulseSolverInSpace, what_slips_along_its_hold_is_left_to_sweeps) {
  std::mt19937 random(13);
  Scene<3> scene = sheet(3, Law::coulomb, 0.2, random);
  for (Contact<3>& contact : scene.contacts) contact.surface = {0.2, 0.3, 0.0};
  Scene<3> swept = scene;
  ASSERT_TRUE(sweep_until_rest(swept, rounding));
  ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 1000);
  EXPECT_LE(difference(scene, swept), 1e-6);
}

// So that a run that is taken up again goes on with the same bits.
TEST(ImpulseSolverInSpace, keeps_nothing_from_earlier_solutions) {
  std::mt19937 random(17);
  ImpulseSolver<3> used;
  for (int trial = 0; trial < 10; ++trial) {
    Scene<3> scene = sheet(3, trial % 2 == 0 ? Law::coulomb : Law::none, 0.2, random), again = scene;
    used.solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 100);
    ImpulseSolver<3>().solve(again.contacts, again.nodes, again.tools, dt, 1e-18, 100);
    for (const BoundaryNodeIndex b : scene.nodes.indices())
      EXPECT_EQ(scene.nodes[b].change, again.nodes[b].change) << trial;
  }
}
