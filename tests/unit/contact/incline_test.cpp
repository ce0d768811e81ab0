// A block on an incline: sliding acceleration g (sin α − μ cos α), stick when tan α < μ.
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr double g = 9.81;

/// A soft block at rest on a plane at `slope`, the whole scene turned by `turn`.
Masses on_incline(double slope, double friction, double turn = 0.0) {
  const double angle = slope + turn;
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0, angle);
  scene.gravity = rotation(turn) * Vec2(0, -g);
  scene.start({tool(rotated(box({-20, -1}, {20, 0}), angle), {0, 0}, friction)});
  return scene;
}

} // namespace

TEST(Incline, SlidesWithTheAccelerationOfCoulombFriction) {
  for (const double slope : {0.2, 0.5, 0.9, 1.3})
    for (const double friction : {0.0, 0.1, 0.15}) {
      Masses scene = on_incline(slope, friction);
      const double dt = 1e-3;
      const Vec2 down = rotation(slope) * Vec2(-1, 0);
      for (int i = 0; i < 1000; ++i) scene.step(dt);
      const double early = scene.momentum().dot(down);
      for (int i = 0; i < 1000; ++i) scene.step(dt);
      const double acceleration = scene.momentum().dot(down) - early; // mass 1, 1 s
      const double expected = g * (std::sin(slope) - friction * std::cos(slope));
      EXPECT_NEAR(acceleration, expected, 1e-3 * g) << "slope " << slope << " friction " << friction;
    }
}

TEST(Incline, SticksBelowTheFrictionAngleAndSlidesAbove) {
  for (const double friction : {0.2, 0.5, 1.0}) {
    const double limit = std::atan(friction);
    for (const double factor : {0.5, 0.95, 1.05}) {
      Masses scene = on_incline(factor * limit, friction);
      for (int i = 0; i < 1500; ++i) scene.step(1e-3);
      const Vec2 settled = scene.centre();
      for (int i = 0; i < 500; ++i) scene.step(1e-3);
      const double moved = (scene.centre() - settled).norm();
      if (factor < 1.0)
        EXPECT_LT(moved, 1e-6) << "friction " << friction << " slope " << factor << " of the limit";
      else
        EXPECT_GT(moved, 0.05) << "friction " << friction;
    }
  }
}

TEST(Incline, ForceOfThePlaneHoldsTheBlock) {
  Masses scene = on_incline(0.3, 0.8);
  for (int i = 0; i < 3000; ++i) scene.step(1e-3);
  EXPECT_LT((scene.contact->results()[0].force - Vec2(0, g)).norm(), 1e-3 * g);
  // at rest nothing is lost any more
  const ContactWork settled = scene.contact->results()[0].total;
  for (int i = 0; i < 100; ++i) scene.step(1e-3);
  EXPECT_LT(scene.contact->results()[0].total.friction - settled.friction, 1e-9);
  EXPECT_LT(scene.contact->results()[0].total.impact - settled.impact, 1e-9);
}

TEST(Incline, FrictionHeatIsTheWorkLost) {
  const double slope = 0.6, friction = 0.3;
  Masses scene = on_incline(slope, friction);
  scene.effusivity.assign(scene.contact->boundary_nodes().size(), 3e3);
  const Vec2 start = scene.centre();
  double heat = 0.0;
  for (int i = 0; i < 1000; ++i) {
    scene.step(1e-3);
    for (const double h : scene.contact->friction_heat()) heat += h;
  }
  const double way = (scene.centre() - start).norm();
  EXPECT_NEAR(heat, friction * g * std::cos(slope) * way, 5e-3 * heat);
  EXPECT_NEAR(heat, scene.contact->results()[0].total.friction, 1e-12 * heat);
}

TEST(Incline, FrictionHeatIsSharedByEffusivity) {
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0, 0.6);
  scene.gravity = {0, -g};
  Tool<2> plane = tool(rotated(box({-20, -1}, {20, 0}), 0.6), {0, 0}, 0.3);
  plane.thermal.effusivity = 1e3;
  scene.start({plane});
  scene.effusivity.assign(scene.contact->boundary_nodes().size(), 3e3);
  double heat = 0.0;
  for (int i = 0; i < 300; ++i) {
    scene.step(1e-3);
    for (const double h : scene.contact->friction_heat()) heat += h;
  }
  const ToolResult<2>& result = scene.contact->results()[0];
  EXPECT_GT(heat, 0.0);
  EXPECT_NEAR(heat, 0.75 * result.total.friction, 1e-12 * heat);
  EXPECT_NEAR(result.heat_to_tool, 0.25 * result.total.friction, 1e-12 * heat);
}

TEST(Incline, TurningTheWholeSceneTurnsTheResult) {
  const double slope = 0.4;
  Masses straight = on_incline(slope, 0.25);
  for (int i = 0; i < 400; ++i) straight.step(1e-3);
  for (const double turn : {0.1, 0.7853981633974483, 1.9, 3.0, 4.4, 6.1}) {
    Masses turned = on_incline(slope, 0.25, turn);
    for (int i = 0; i < 400; ++i) turned.step(1e-3);
    for (int i = 0; i < int(straight.mass.size()); ++i) {
      EXPECT_LT((turned.position(i) - rotation(turn) * straight.position(i)).norm(), 1e-10) << turn;
      EXPECT_LT((turned.velocity(i) - rotation(turn) * straight.velocity(i)).norm(), 1e-9) << turn;
    }
    EXPECT_LT((turned.contact->results()[0].impulse - rotation(turn) * straight.contact->results()[0].impulse)
                  .norm(),
              1e-9);
    EXPECT_NEAR(turned.contact->results()[0].total.friction, straight.contact->results()[0].total.friction,
                1e-9);
  }
}
