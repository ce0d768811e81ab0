// Tools with a mass of their own: flight under a force, momentum and energy shared with the workpiece, light
// and guided tools.
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

Tool<2> free_tool(const Curve& curve, double mass, const Vec2& velocity, const Vec2& force = {0, 0},
                  double friction = 0.0) {
  Tool<2> made = tool(curve, {0, 0}, friction);
  made.drive = ToolDrive<2>{mass, {TimeTable(force.x()), TimeTable(force.y())}, velocity};
  return made;
}

Mat2 along(const Vec2& direction) {
  const Vec2 u = direction.normalized();
  return u * u.transpose();
}

Vec2 tool_momentum(const Masses& scene, std::size_t t = 0) {
  return scene.contact->tools()[t].drive->mass * scene.contact->velocity(t, scene.time);
}

/// Σ ½ M V_{n−½}², as kinetic() of the nodes is.
double tool_kinetic(const Masses& scene, std::size_t t = 0) {
  return 0.5 * scene.contact->tools()[t].drive->mass * scene.contact->velocity(t, scene.time).squaredNorm();
}

} // namespace

TEST(FreeTool, FliesAsNewtonSaysWithAnyStep) {
  Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 100.0);
  Tool<2> steady = free_tool(box({-1, 10}, {1, 11}), 2.5, {0.3, -0.2}, {1.0, -3.0});
  Tool<2> ramped = free_tool(box({-1, 20}, {1, 21}), 4.0, {0, 0});
  ramped.drive->force[1] = TimeTable({0.0, 0.5}, {0.0, -2.0});
  scene.start({steady, ramped});
  double dt = 1e-2;
  for (int i = 0; i < 120; ++i) {
    scene.step(dt);
    dt *= i % 3 == 0 ? 1.1 : 1.0 / 1.05;
    const double t = scene.time;
    const Vec2 exact = t * Vec2(0.3, -0.2) + 0.5 * t * t / 2.5 * Vec2(1.0, -3.0);
    ASSERT_LT((scene.contact->displacement(0, t) - exact).norm(), 1e-13) << "step " << i;
    const double s = std::min(t, 0.5), u = t - s; // ∫∫F of the ramp, then of the constant force
    const double ramp = -2.0 / 4.0 * (s * s * s / (6.0 * 0.5) + 0.25 * u + 0.5 * u * u);
    ASSERT_NEAR(scene.contact->displacement(1, t).y(), ramp, 1e-5) << "step " << i;
  }
  ASSERT_GT(scene.time, 0.8);
  const DriveEnergy energy = scene.contact->drive_energy();
  EXPECT_NEAR(energy.kinetic - energy.work, 0.5 * 2.5 * Vec2(0.3, -0.2).squaredNorm(), 1e-13);
  const double half = scene.time - 0.5 * scene.dt_before;
  const double end = half - 0.25; // the ramped tool is as fast as one whose force was switched on at 0.25
  EXPECT_NEAR(energy.kinetic,
              0.5 * 2.5 * (Vec2(0.3, -0.2) + half / 2.5 * Vec2(1.0, -3.0)).squaredNorm() +
                  0.5 * 4.0 * std::pow(0.5 * end, 2),
              1e-12);
}

TEST(FreeTool, SharesMomentumAndEnergyWithTheWorkpiece) {
  for (const double friction : {0.0, 0.3})
    for (const double mass : {20.0, 0.7, 0.02}) {
      Masses scene = block(8, 5, 0.1, {0.0, 0.0}, 50.0, 0.02);
      scene.start(
          {free_tool(rounded_box({0.2, 0.41}, {0.53, 1.0}, 0.06), mass, {0.4, -1.0}, {0, 0}, friction)});
      const Vec2 before = scene.momentum() + tool_momentum(scene);
      const double kinetic = scene.kinetic() + tool_kinetic(scene), scale = mass * 1.08;
      double dt = 5e-4;
      for (int i = 0; i < 600; ++i) {
        scene.step(dt);
        dt *= i % 2 == 0 ? 1.05 : 1.0 / 1.05;
        ASSERT_LT((scene.momentum() + tool_momentum(scene) - before).norm(), 1e-13 * scale) << "step " << i;
      }
      const ContactWork work = scene.contact->results()[0].total;
      EXPECT_GT(scene.contact->results()[0].impulse.norm(), 0.1 * std::min(mass, 1.0));
      EXPECT_EQ(work.friction > 0.0, friction > 0.0);
      // what the tool gives is what the books of contact say the workpiece received, friction and impact
      // apart
      EXPECT_NEAR(tool_kinetic(scene) + scene.kinetic() - scene.applied_work,
                  kinetic - work.friction - work.impact + work.recovery, 1e-13 * scale);
      EXPECT_LT(work.recovery, 0.02 * kinetic);
    }
}

TEST(FreeTool, OfAnyMassIsStoppedInelasticallyByARowOfNodes) {
  // n loose nodes in a row under a flat tool: after one step they have their common velocity, exactly
  for (const double mass : {1e3, 1.0, 1e-3, 1e-6}) {
    const int n = 60;
    Masses scene;
    std::vector<int> loop;
    for (int i = 0; i < n; ++i) loop.push_back(scene.add({0.1 * i, 0.0}, 1.0 + 0.5 * (i % 3)));
    loop.push_back(scene.add({0.1 * (n - 1), -1.0}, 1.0));
    loop.push_back(scene.add({0.0, -1.0}, 1.0));
    std::reverse(loop.begin(), loop.end());
    scene.loop(loop);
    scene.start({free_tool(box({-1, 0}, {0.1 * n + 1, 1}), mass, {0, -2.0})});
    scene.step(1e-3);
    double row = 0.0;
    for (int i = 0; i < n; ++i) row += scene.mass[std::size_t(i)];
    const double common = -2.0 * mass / (mass + row);
    EXPECT_NEAR(scene.contact->velocity(0, scene.time).y(), common, 1e-13 * 2.0) << "mass " << mass;
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(scene.velocity(i).y(), common, 1e-13 * 2.0) << "mass " << mass << " node " << i;
  }
}

TEST(FreeTool, MovesAlongItsGuideOnly) {
  Masses scene = block(6, 4, 0.1, {0.0, 0.0}, 100.0, 1.0);
  Tool<2> ram = free_tool(rotated(box({-0.5, 0.42}, {2, 1}), -0.2), 3.0, {0, -1.0}, {5.0, -2.0});
  ram.drive->free = along({0, 1});
  scene.start({ram, tool(box({-1, -1}, {2, 0}))});
  const Vec2 before = scene.momentum() + tool_momentum(scene);
  for (int i = 0; i < 2000; ++i) scene.step(5e-4);
  EXPECT_EQ(scene.contact->displacement(0, scene.time).x(), 0.0);
  EXPECT_GT(std::abs(scene.contact->results()[0].impulse.x()),
            0.05); // its face is inclined: the guide holds it
  const double pushed = -2.0 * (scene.time - 0.5 * scene.dt_before);
  EXPECT_NEAR((scene.momentum() + tool_momentum(scene) - before).y(),
              pushed + scene.contact->results()[1].impulse.y(), 1e-12);
}

TEST(FreeTool, StopsOnNodesThatAreHeld) {
  Masses scene = block(4, 3, 0.1, {0.0, 0.0}, 100.0);
  for (int i = 0; i < 12; ++i) scene.constraints.push_back({as<NodeIndex>(i), Mat2::Zero()});
  scene.start({free_tool(box({-1, 0.25}, {2, 1}), 2.0, {0, -1.0}, {0, -5.0})});
  for (int i = 0; i < 200; ++i) scene.step(1e-3);
  EXPECT_NEAR(scene.contact->displacement(0, scene.time).y(), -0.05, 1e-12);
  EXPECT_NEAR(scene.contact->results()[0].force.y(), -5.0, 1e-9);
}

TEST(FreeTool, UnderAForceComesToRestWhereTheSpringsCarryIt) {
  // a column of four rows: 3 springs in series, 6 in parallel, the diagonals left out
  const int nx = 6, ny = 4;
  for (const double mass : {5.0, 1e-3}) {
    Masses scene = block(nx, ny, 0.1, {0.0, 0.0}, 0.0);
    scene.springs.clear();
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i < nx; ++i) scene.link(j * nx + i, (j + 1) * nx + i, 200.0, 12.0);
    Tool<2> press = free_tool(box({-1, 0.3}, {2, 1}), mass, {0, 0});
    press.drive->force[1] = TimeTable({0.0, 0.5}, {0.0, -6.0});
    scene.start({tool(box({-1, -1}, {2, 0})), press});
    for (int i = 0; i < 30000; ++i) scene.step(5e-4);
    EXPECT_NEAR(scene.contact->displacement(1, scene.time).y(), -6.0 * 3.0 / (nx * 200.0), 1e-9);
    EXPECT_NEAR(scene.contact->results()[1].force.y(), -6.0, 1e-8);
    EXPECT_NEAR(scene.contact->results()[0].force.y(), 6.0, 1e-8);
  }
}

TEST(FreeTool, NeedsAMass) {
  EXPECT_ANY_THROW(RigidContact<2>({free_tool(box({0, 0}, {1, 1}), 0.0, {0, 0})}));
}
