// Tools that answer nodes inside them one by one: a penalty spring, a kinematic tool.
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr double step_length = 1e-3; ///< s

/// One node of 1 kg/m at `depth` below the top of a wall, beside others far away, all with this velocity.
Masses inside_wall(double depth, const Vec2& velocity, const Response& response, const Vec2& drive = {0, 0},
                   double friction = 0.0) {
  Masses scene;
  std::vector<int> loop{scene.add({0, -depth}, 1.0, velocity)};
  for (const Vec2& far : {Vec2(4, 3), Vec2(-4, 3)}) loop.push_back(scene.add(far, 1.0, velocity));
  scene.loop(loop);
  Tool<2> wall = tool(box({-2, -2}, {2, 0}), drive, friction);
  wall.response = response;
  scene.start({wall});
  scene.dt_before = step_length;
  return scene;
}

void expect_balanced(const ContactWork& work) {
  const double scale = std::abs(work.workpiece) + std::abs(work.tool) + work.friction + work.impact;
  EXPECT_NEAR(work.workpiece, work.tool + work.recovery - work.friction - work.impact, 1e-12 * scale);
  EXPECT_GE(work.friction, 0.0);
  EXPECT_GE(work.impact, 0.0);
  EXPECT_GE(work.recovery, 0.0);
}

} // namespace

TEST(PenaltyResponse, IsASpringOfTheStepsStiffness) {
  for (const double scale : {0.5, 1.0, 2.0}) {
    Masses scene = inside_wall(1e-4, {0, 0}, Penalty{scale});
    scene.step(step_length);
    EXPECT_NEAR(scene.velocity(0).y(), scale * 1e-4 / step_length, 1e-12); // paper 000, (39): f = 2 M g/Δt²
    EXPECT_NEAR(scene.contact->results()[0].force.y(), scale * 1e-4 / (step_length * step_length), 1e-7);
    EXPECT_EQ(scene.velocity(1).y(), 0.0);
  }
}

TEST(PenaltyResponse, BouncesWithTheSpeedItCameWith) {
  Masses scene = inside_wall(-0.5e-3, {0, -1}, Penalty{0.01});
  double deepest = 0.0;
  for (int i = 0; i < 60; ++i) {
    scene.step(step_length);
    deepest = std::min(deepest, scene.position(0).y());
  }
  EXPECT_NEAR(deepest, -1.0 * step_length / 0.1, 0.01 * step_length / 0.1); // v/ω, ω = √scale/Δt
  EXPECT_NEAR(scene.velocity(0).y(), 1.0, 0.06); // it leaves the wall between two steps
  expect_balanced(scene.contact->results()[0].total);
}

TEST(PenaltyResponse, SticksOrSlipsAsCoulombSays) {
  const double press = 1e-4 / step_length;
  for (const double sliding : {0.01, 1.0}) {
    Masses scene = inside_wall(1e-4, {sliding, 0}, Penalty{}, {0, 0}, 0.2);
    scene.step(step_length);
    EXPECT_NEAR(scene.velocity(0).x(), std::max(0.0, sliding - 0.2 * press), 1e-12); // paper 000, (40), (41)
    expect_balanced(scene.contact->results()[0].step);
  }
}

TEST(PenaltyResponse, SharesMomentumWithAFreeTool) {
  Masses scene = inside_wall(1e-4, {0, 0}, Exact{});
  Tool<2> wall = tool(box({-2, -2}, {2, 0}));
  wall.response = Penalty{1.0};
  wall.drive.emplace().mass = 3.0;
  scene.start({wall});
  scene.step(step_length);
  const double speed = scene.velocity(0).y();
  EXPECT_NEAR(speed + 3.0 * scene.contact->velocity(0, scene.time).y(), 0.0, 1e-15);
  EXPECT_NEAR(speed, 0.75 * 1e-4 / step_length, 1e-12); // the reduced mass
}

// contact.scheme = "central-difference" of paper 000: springs of 2 m/Δt².
namespace {
constexpr double steep = 2.0;
}

/// Written out step by step for a node at rest: f_n = 2 m g/Δt² (39) of the depth g that it has when a step
/// begins.
TEST(CentralDifference, ANodeBeforeAMovingWallIsAsDeepInAsTheRecurrenceSays) {
  const double speed = 0.5, mass = 1.0;
  Masses scene = inside_wall(-0.2 * speed * step_length, {0, 0}, Penalty{steep}, {0, speed});
  double place = 0.2 * speed * step_length, velocity = 0.0, wall = 0.0, pushed = 0.0, deepest = 0.0;
  for (int n = 0; n < 12; ++n) {
    const double depth = std::max(0.0, wall - place); // at t_n
    const double force = 2.0 * mass * depth / (step_length * step_length);
    velocity += force / mass * step_length;
    place += velocity * step_length;
    wall += speed * step_length;
    pushed += force * step_length;
    deepest = std::max(deepest, depth);
    scene.step(step_length);
    EXPECT_NEAR(scene.position(0).y(), place, 1e-15);
    EXPECT_NEAR(scene.velocity(0).y(), velocity, 1e-12);
    EXPECT_NEAR(scene.contact->results()[0].force.y(), force, 1e-9);
    EXPECT_NEAR(scene.contact->results()[0].impulse.y(), pushed, 1e-12);
    EXPECT_NEAR(mass * scene.velocity(0).y(), pushed, 1e-12) << "momentum";
  }
  EXPECT_NEAR(deepest, 0.8 * speed * step_length, 1e-15) << "the path of a step less the gap there was";
  EXPECT_NEAR(velocity, 2.0 * speed, 1e-12) << "thrown off as fast as it was met";
  expect_balanced(scene.contact->results()[0].total);
}

/// (40), m v/Δt, against (41), μ f_n: the smaller, along the face (43).
TEST(CentralDifference, RubsWithTheSmallerOfStickAndSlip) {
  const double depth = 1e-4, press = 2.0 * depth / step_length, friction = 0.3;
  for (const double sliding : {0.2 * friction * press, 5.0 * friction * press}) {
    Masses scene = inside_wall(depth, {sliding, 0}, Penalty{steep}, {0, 0}, friction);
    scene.step(step_length);
    const Vec2 force = scene.contact->results()[0].force;
    EXPECT_NEAR(force.y(), press / step_length, 1e-9);
    EXPECT_NEAR(-force.x(), std::min(sliding, friction * press) / step_length, 1e-9);
    EXPECT_NEAR(scene.velocity(0).x(), sliding - std::min(sliding, friction * press), 1e-12);
    expect_balanced(scene.contact->results()[0].step);
  }
}

TEST(PenaltyResponse, TheStepItBearsIsThatOfBothSprings) {
  for (const double share : {0.95, 1.05}) {
    const Penalty law{2.0};
    // a spring from a heavy mass presses the node into the wall, one that alone would bear this step by far
    const double omega = 2.0 * share * law.step_share() / step_length;
    const double wall = law.scale / (step_length * step_length), spring = omega * omega, depth = 1e-3;
    Masses scene = inside_wall(depth, {0, 0}, law);
    scene.link(0, scene.add({0, 1}, 1e12), spring);
    scene.springs.back().length += depth * wall / spring;
    const double shaken = 1e-9;
    scene.x[1][0] += shaken;
    double widest = 0.0;
    for (int i = 0; i < 100; ++i) {
      scene.step(step_length);
      widest = std::max(widest, std::abs(scene.position(0).y() + depth));
    }
    if (share < 1.0)
      EXPECT_LT(widest, 10.0 * shaken);
    else
      EXPECT_GT(widest, 1e4 * shaken);
  }
}

TEST(KinematicResponse, NodesTakeTheSpeedAheadAndKeepTheirsAcross) {
  // a rake face of 20 degrees that moves to the right
  const double rake = 20.0 * std::numbers::pi / 180.0;
  Masses scene;
  std::vector<int> loop{scene.add({-1e-4, 0.0}, 1.0, {0.5, 0.3})};
  for (const Vec2& far : {Vec2(4, -3), Vec2(4, 3)}) loop.push_back(scene.add(far, 1.0, {0.5, 0.3}));
  scene.loop(loop);
  const double lean = std::tan(rake);
  Tool<2> cutter = tool(polygon({{-3.0, -1.0}, {lean, -1.0}, {-lean, 1.0}, {-3.0, 1.0}}), {2, 0});
  cutter.response = Kinematic{};
  scene.start({cutter});
  scene.dt_before = step_length;
  scene.step(step_length);
  EXPECT_NEAR(scene.velocity(0).x(), 2.0, 1e-12);
  EXPECT_NEAR(scene.velocity(0).y(), 0.3, 1e-12);
  EXPECT_NEAR(scene.velocity(1).x(), 0.5, 0.0);
  const Vec2 force = scene.contact->results()[0].force;
  const Vec2 normal(std::cos(rake), std::sin(rake)), along(-std::sin(rake), std::cos(rake));
  EXPECT_NEAR(force.x(), 1.5 / step_length, 1e-9);
  EXPECT_NEAR(force.dot(normal), 1.5 / step_length * std::cos(rake), 1e-9); // paper 003, (24)
  EXPECT_NEAR(std::abs(force.dot(along)), std::tan(rake) * force.dot(normal), 1e-9);
  expect_balanced(scene.contact->results()[0].step);
}

TEST(KinematicResponse, LeavesFastNodesAndFacesThatDoNotGoAhead) {
  for (const Vec2& drive : {Vec2(0, -1), Vec2(1, 0)}) { // away from the node; along the face
    Masses scene = inside_wall(1e-4, {0.2, 0.1}, Kinematic{}, drive);
    scene.step(step_length);
    EXPECT_EQ(scene.velocity(0), Vec2(0.2, 0.1));
    EXPECT_TRUE(scene.contact->results()[0].force.isZero(0.0));
  }
  Masses fast = inside_wall(1e-4, {0.0, 3.0}, Kinematic{}, {0, 1});
  fast.step(step_length);
  EXPECT_EQ(fast.velocity(0), Vec2(0.0, 3.0));
}
