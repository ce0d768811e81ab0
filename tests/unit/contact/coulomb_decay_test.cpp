// Friction that falls with the speed of slip.
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr CoulombDecay law{.static_coefficient = 0.5, .kinetic_coefficient = 0.1, .decay_speed = 2.0};

} // namespace

TEST(CoulombDecay, IsItsFormula) {
  const Friction friction = law;
  EXPECT_TRUE(friction.needs_speed());
  EXPECT_FALSE(friction.needs_flow_stress());
  EXPECT_DOUBLE_EQ(friction.bound({.speed = 0.0}).coefficient, 0.5);
  EXPECT_DOUBLE_EQ(friction.bound({.speed = 3.0}).coefficient, 0.1 + 0.4 * std::exp(-1.5));
  EXPECT_NEAR(friction.bound({.speed = 100.0}).coefficient, 0.1, 1e-15);
  EXPECT_TRUE(std::isinf(friction.bound({}).shear));
}

/// A block of 1 kg/m on a belt that runs away: the drag is μ(slip) g.
TEST(CoulombDecay, DragsByTheSpeedOfSlip) {
  for (const double speed : {3.0, 6.0, 20.0}) {
    Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0);
    scene.gravity = {0, -9.81};
    Tool<2> belt = tool(box({-20, -1}, {200, 0}), {speed, 0.0});
    belt.friction = law;
    scene.start({belt});
    for (int i = 0; i < 300; ++i) scene.step(1e-3);
    const double before = scene.momentum().x();
    for (int i = 0; i < 100; ++i) scene.step(1e-3);
    const double after = scene.momentum().x(), slip = speed - 0.5 * (before + after);
    const double drag = (after - before) / 0.1;
    EXPECT_NEAR(drag, 9.81 * (0.1 + 0.4 * std::exp(-slip / 2.0)), 0.03 * drag) << "belt at " << speed;
  }
}

TEST(CoulombDecay, HoldsWhatRests) {
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0);
  scene.gravity = {0.4 * 9.81, -9.81}; // below the coefficient at rest, four times that of fast slip
  Tool<2> plane = tool(box({-20, -1}, {20, 0}));
  plane.friction = law;
  scene.start({plane});
  for (int i = 0; i < 1500; ++i) scene.step(1e-3);
  const Vec2 settled = scene.centre();
  for (int i = 0; i < 500; ++i) scene.step(1e-3);
  EXPECT_LT((scene.centre() - settled).norm(), 1e-5);
}
