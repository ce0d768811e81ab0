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

/// A square of side² nodes, those of its first row held across the row (a plane of symmetry).
Scene<3> sheet(int side, Law law, double coefficient, std::mt19937& random) {
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Scene<3> scene;
  scene.tools.resize(1);
  for (int i = 0; i < side * side; ++i) {
    Reaction<3> node;
    node.inverse = Mat<3>::Identity() / (0.5 + any(random));
    if (i < side) node.inverse(1, 1) = 0.0;
    node.velocity = Vec3(any(random) - 0.3, i < side ? 0.0 : any(random) - 0.5, -any(random));
    scene.nodes.push_back(node);
  }
  const auto at = [&](int x, int y) { return as<BoundaryNodeIndex>(x + side * y); };
  const auto normal = [](double x, double y) { return Vec3(0.1 * x, 0.1 * y, 1.0).normalized(); };
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
  for (const Law law : {Law::none, Law::coulomb, Law::smooth})
    for (const int side : {1, 2, 4})
      for (int trial = 0; trial < 10; ++trial) {
        Scene<3> scene = sheet(side, law, 0.2, random), swept = scene;
        const double depth = scene.deepest();
        sweep_until_rest(swept);
        ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 1000);
        expect_solved(scene, depth);
        EXPECT_LE(difference(scene, swept), 1e-6) << "law " << int(law) << ", " << side << ", " << trial;
      }
}

TEST(ImpulseSolverInSpace, needs_few_sweeps) {
  std::mt19937 random(11);
  int few = 0, few_alone = 0;
  constexpr int trials = 50;
  for (int trial = 0; trial < trials; ++trial) {
    Scene<3> scene = sheet(4, Law::coulomb, 0.2, random), solved = scene, swept = scene;
    sweep_until_rest(solved);
    ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 3);
    few += difference(scene, solved) < 1e-6;
    for (int n = 0; n < 3; ++n) sweep(swept);
    few_alone += difference(swept, solved) < 1e-6;
  }
  EXPECT_LE(few_alone, trials / 5);
  EXPECT_GE(few, trials * 8 / 10);
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
