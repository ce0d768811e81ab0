// A bar against a wall, impulse against change of momentum, energy books, start-up penetration, ramps.
#include "core/error.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

void expect_balanced(const ContactWork& work, double scale) {
  EXPECT_NEAR(work.workpiece, work.tool + work.recovery - work.friction - work.impact, 1e-12 * scale);
  EXPECT_GE(work.friction, 0.0);
  EXPECT_GE(work.impact, 0.0);
  EXPECT_GE(work.recovery, 0.0);
}

double elastic(const Masses& scene) {
  double sum = 0.0;
  for (const Masses::Spring& s : scene.springs)
    sum += 0.5 * s.stiffness * std::pow((scene.position(s.b) - scene.position(s.a)).norm() - s.length, 2);
  return sum;
}

} // namespace

TEST(Bar, AgainstAWallHasForceRhoCVAndDuration2LOverC) {
  // two rows of masses with springs along x only: density 1, modulus 1, so c = 1; height 0.1
  const int n = 201;
  const double length = 1.0, h = length / (n - 1), height = 0.1, speed = 1e-3;
  Masses bar;
  std::vector<int> loop;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < n; ++i)
      bar.add({i * h, row * height}, 0.5 * height * h * (i == 0 || i == n - 1 ? 0.5 : 1.0), {-speed, 0.0});
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i + 1 < n; ++i) bar.link(row * n + i, row * n + i + 1, 0.5 * height / h);
  for (int i = 0; i < n; ++i) loop.push_back(i);
  for (int i = n - 1; i >= 0; --i) loop.push_back(n + i);
  bar.loop(loop);
  bar.start({tool(box({-1.0, -1.0}, {0.0, 1.0}))});
  const Vec2 before = bar.momentum();
  const double kinetic = bar.kinetic(), dt = 0.5 * h;
  const auto steps_per_transit = static_cast<int>(std::lround(length / dt));
  double mean_force = 0.0, last_push = 0.0;
  int counted = 0;
  for (int i = 0; i < 3 * steps_per_transit; ++i) {
    bar.step(dt);
    const double force = bar.contact->results()[0].force.x();
    if (force > 0.0) last_push = bar.time;
    if (bar.time > 0.2 && bar.time < 1.8) {
      mean_force += force;
      ++counted;
    }
  }
  EXPECT_NEAR(mean_force / counted, speed * height, 0.01 * speed * height);
  EXPECT_NEAR(last_push, 2.0 * length, 0.03 * length);
  const ToolResult<2>& wall = bar.contact->results()[0];
  EXPECT_LT((bar.momentum() - before - wall.impulse).norm(), 1e-12 * before.norm());
  EXPECT_NEAR(wall.impulse.x(), 2.0 * bar.total_mass() * speed, 0.02 * bar.total_mass() * speed);
  expect_balanced(wall.total, kinetic);
  EXPECT_EQ(wall.total.tool, 0.0);
  EXPECT_NEAR(wall.total.impact, 0.5 * height * h * 0.5 * speed * speed, 0.05 * wall.total.impact);
}

TEST(Impulse, IsTheChangeOfMomentumForAnyMotionAndFriction) {
  for (const double friction : {0.0, 0.3, 5.0}) {
    Masses scene = block(8, 5, 0.1, {0.0, 0.0}, 50.0, 0.02, 0.0, {0.3, -1.0});
    Tool<2> punch = tool(rounded_box({0.2, 0.41}, {0.53, 1.0}, 0.06), {0, 0}, friction);
    punch.motion.velocity = {TimeTable(0.1), TimeTable({0.0, 0.2, 0.4}, {0.0, -0.8, -0.1})};
    scene.start({tool(box({-1, -1}, {0.3, 0}), {0, 0}, friction), punch,
                 tool(rotated(box({-2, -1}, {2, -0.3}), 0.4), {0, 0}, friction)});
    const Vec2 before = scene.momentum();
    const double energy = scene.kinetic();
    double scale = 0.0, dt = 5e-4;
    for (int i = 0; i < 1000; ++i) {
      scene.step(dt);
      dt *= i % 2 == 0 ? 1.05 : 1.0 / 1.05; // variable step
      for (const ToolResult<2>& result : scene.contact->results()) scale += result.force.norm() * dt;
    }
    Vec2 impulse = Vec2::Zero();
    ContactWork work;
    for (const ToolResult<2>& result : scene.contact->results()) {
      impulse += result.impulse;
      work += result.total;
      expect_balanced(result.total, scale);
    }
    EXPECT_GT(scale, 0.1);
    EXPECT_LT((scene.momentum() - before - impulse).norm(), 1e-12 * scale);
    EXPECT_NEAR(scene.kinetic(), energy + scene.applied_work + work.workpiece, 1e-12 * scale);
    EXPECT_GT(work.impact, 0.0);
    EXPECT_EQ(work.friction > 0.0, friction > 0.0);
    EXPECT_LT(work.recovery, 0.02 * (work.impact + work.friction + std::abs(work.tool)));
  }
}

TEST(Energy, OfABlockThatBouncesIsKept) {
  Masses scene = block(8, 5, 0.1, {0.0, 0.01}, 50.0, 0.0, 0.0, {0.0, -0.2});
  scene.start({tool(box({-1, -1}, {2, 0}))});
  const double before = scene.kinetic();
  for (int i = 0; i < 4000; ++i) scene.step(5e-4);
  const ContactWork work = scene.contact->results()[0].total;
  EXPECT_GT(scene.momentum().y(), 0.1);
  EXPECT_EQ(work.tool, 0.0);
  EXPECT_NEAR(scene.kinetic() + elastic(scene) + work.impact - work.recovery, before, 2e-3 * before);
  EXPECT_LT(work.recovery, 1e-12 * before);
}

TEST(Motion, ATouchingToolCarriesItsNodesThroughARamp) {
  Masses scene = block(4, 3, 0.1, {0.0, 0.0}, 2e3, 10.0);
  Tool<2> pusher = tool(box({-1, -1}, {1, 0}));
  pusher.motion.velocity[1] = TimeTable({0.0, 0.5}, {0.0, 1.0});
  scene.start({pusher});
  for (int i = 0; i < 2000; ++i) scene.step(5e-4);
  EXPECT_NEAR(scene.contact->results()[0].displacement.y(), 0.75, 1e-12);
  // no gravity: carried up and let go at the end of the ramp with the speed of the tool
  EXPECT_NEAR(scene.momentum().y(), 1.0, 0.05);
  const ContactWork work = scene.contact->results()[0].total;
  EXPECT_NEAR(work.tool, work.workpiece, 1e-3 * work.tool);
  for (int i = 0; i < 4; ++i) EXPECT_GE(scene.position(i).y(), 0.75 - 1e-12);
}

TEST(Motion, WorkOfAPunchIsForceTimesStroke) {
  Masses scene = block(6, 4, 0.1, {0.0, 0.0}, 100.0, 5.0);
  scene.start({tool(box({-1, -1}, {2, 0})), tool(box({-1, 0.3}, {2, 1}), {0, -0.01})});
  double work = 0.0;
  const double dt = 5e-4;
  for (int i = 0; i < 4000; ++i) {
    scene.step(dt);
    work += scene.contact->results()[1].force.y() * -0.01 * dt;
  }
  const auto& results = scene.contact->results();
  EXPECT_NEAR(results[1].total.tool, work, 1e-3 * work);
  EXPECT_NEAR(results[0].force.y(), -results[1].force.y(), 1e-2 * results[0].force.y()); // equilibrium
  EXPECT_NEAR(results[0].force.y(), results[0].force.norm(), 1e-9);
  EXPECT_EQ(results[0].total.tool, 0.0);
  EXPECT_GT(results[0].force.y(), 0.1);
}

TEST(StartUp, PenetrationIsPushedOutAtHalfTheToolSpeed) {
  Masses scene;
  scene.square({0, 0}, 0.1);
  const double depth = 0.02, dt = 1e-4;
  scene.start({tool(box({-1, 0.1 - depth}, {1, 1}), {0, -1})});
  const auto found = scene.contact->overlaps(scene.x, 0.0);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].tool, 0_tool);
  EXPECT_NEAR(found[0].depth, depth, 1e-14);
  scene.step(dt);
  EXPECT_NEAR(scene.velocity(2).y(), -1.5, 1e-9);
  EXPECT_NEAR(scene.velocity(3).y(), -1.5, 1e-9);
  EXPECT_EQ(scene.velocity(0).norm(), 0.0);
  for (int i = 0; i < 450; ++i) scene.step(dt); // free from the tool, they stay ahead of it
  EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty());
  EXPECT_NEAR(scene.velocity(2).y(), -1.5, 1e-9);
  expect_balanced(scene.contact->results()[0].total, 1.0);
}

TEST(StartUp, PenetrationOfARestingToolIsHeld) {
  Masses scene = block(3, 3, 0.1, {0.0, -0.01}, 100.0);
  scene.gravity = {0, -1};
  scene.start({tool(box({-1, -1}, {2, 0}))});
  scene.step(1e-3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(scene.position(i).y(), -0.01, 1e-15);
    EXPECT_NEAR(scene.velocity(i).y(), 0.0, 1e-15);
  }
}

TEST(Constraint, OfSymmetryIsNeverViolated) {
  // an oblique wedge pushes a block whose left side slides on x = 0; the reaction of the wedge is normal to
  // it
  Masses scene = block(5, 4, 0.1, {0.0, 0.0}, 200.0, 2.0);
  Mat2 vertical = Mat2::Zero();
  vertical(1, 1) = 1.0;
  for (int j = 0; j < 4; ++j) scene.constraints.push_back({as<NodeIndex>(5 * j), vertical});
  scene.start({tool(rotated(box({-3, 0.3}, {3, 1}), 0.3), {0, -0.2}, 0.2), tool(box({-1, -1}, {2, -0.05}))});
  for (int i = 0; i < 5000; ++i) scene.step(2e-4);
  for (int j = 0; j < 4; ++j) EXPECT_EQ(scene.position(5 * j).x(), 0.0);
  EXPECT_GT(scene.contact->results()[0].impulse.norm(), 0.01);
  EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty());
}

TEST(Constraint, NodesThatCannotMoveAreLeftAlone) {
  Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 100.0);
  for (int i = 0; i < 9; ++i) scene.constraints.push_back({as<NodeIndex>(i), Mat2::Zero()});
  scene.start({tool(box({-1, 0.15}, {2, 1}), {0, -1}, 0.5)});
  for (int i = 0; i < 10; ++i) scene.step(1e-3);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(scene.velocity(i).norm(), 0.0);
  EXPECT_EQ(scene.contact->results()[0].impulse.norm(), 0.0);
}

TEST(Friction, ForceIsLimitedByTheShearStrength) {
  // pressed hard by gravity on a belt that runs away: the drag is m_f σ_y/√3 times the length of contact
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0);
  scene.gravity = {0, -9.81};
  Tool<2> belt = tool(box({-200, -1}, {20, 0}), {50.0, 0.0}, 0.5);
  belt.friction = TrescaLimited{0.5, 0.6};
  scene.start({belt});
  EXPECT_TRUE(scene.contact->flow_stress_needed());
  const double flow_stress = 3.0;
  scene.flow_stress.assign(scene.contact->boundary_nodes().size(), flow_stress);
  for (int i = 0; i < 2000; ++i) scene.step(1e-3);
  const double before = scene.momentum().x();
  for (int i = 0; i < 500; ++i) scene.step(1e-3);
  const double drag = (scene.momentum().x() - before) / 0.5;
  const double area = 0.1 * 5; // five edges, not the upright ones beside them
  EXPECT_NEAR(drag, 0.6 * flow_stress / std::numbers::sqrt3 * area, 0.02 * drag);
  EXPECT_LT(drag, 0.5 * 9.81 * 0.9); // below Coulomb
}

TEST(Friction, OutOfItsRangeIsAnError) {
  for (const Friction& friction : {Friction(Coulomb{-0.1}), Friction(TrescaLimited{0.1, 1.5})})
    EXPECT_THROW(RigidContact<2>({[&] {
                   Tool<2> made = tool(box({0, 0}, {1, 1}));
                   made.friction = friction;
                   return made;
                 }()}),
                 InputError);
}

TEST(Friction, AShearFactorWithoutFlowStressIsAnError) {
  Masses scene = block(3, 3, 0.1, {0.0, 0.0}, 100.0);
  Tool<2> belt = tool(box({-20, -1}, {20, 0}), {5.0, 0.0}, 0.5);
  belt.friction = TrescaLimited{0.5, 0.6};
  scene.start({belt});
  EXPECT_ANY_THROW(scene.step(1e-3));
}
