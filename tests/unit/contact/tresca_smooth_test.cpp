// Friction that passes smoothly from Coulomb's law into the strength in shear.
#include "core/error.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr TrescaSmooth law{.coefficient = 0.5, .shear_factor = 0.6};

/// A block of 1 kg/m, three rows of six masses, pressed on a belt that runs away by its weight.
Masses block_on_a_belt(double flow_stress, const Friction& friction) {
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0);
  scene.gravity = {0, -9.81};
  Tool<2> belt = tool(box({-200, -1}, {20, 0}), {50.0, 0.0});
  belt.friction = friction;
  scene.start({belt});
  scene.flow_stress.assign(scene.contact->boundary_nodes().size(), flow_stress);
  for (int i = 0; i < 1500; ++i) scene.step(1e-3);
  return scene;
}

double drag(Masses& scene) {
  const double before = scene.momentum().x();
  for (int i = 0; i < 500; ++i) scene.step(1e-3);
  return (scene.momentum().x() - before) / 0.5;
}

} // namespace

TEST(TrescaSmooth, IsItsFormula) {
  const Friction friction = law;
  EXPECT_TRUE(friction.needs_flow_stress());
  EXPECT_FALSE(friction.needs_speed());
  const FrictionBound bound = friction.bound({.flow_stress = 500e6});
  EXPECT_DOUBLE_EQ(bound.coefficient, 0.5);
  EXPECT_DOUBLE_EQ(bound.shear, 0.6 * 500e6 / std::numbers::sqrt3);
  EXPECT_TRUE(bound.smooth);
  Contact<2> contact;
  contact.coulomb = 0.5;
  contact.limit = 3.0;
  contact.smooth = true;
  for (const double pressing : {1e-9, 0.1, 6.0, 40.0, 1e6}) {
    contact.pressing = pressing;
    EXPECT_NEAR(contact.strength(), 3.0 * (1.0 - std::exp(-0.5 * pressing / 3.0)), 1e-15) << pressing;
  }
  contact.pressing = 1e-9;
  EXPECT_NEAR(contact.strength(), 0.5e-9, 1e-18) << "Coulomb's law at low pressure";
  contact.pressing = 0.0;
  EXPECT_EQ(contact.strength(), 0.0);
  contact.pressing = 1.0;
  contact.limit = 0.0;
  EXPECT_EQ(contact.strength(), 0.0) << "no strength where the workpiece has none";
  EXPECT_THROW(Friction(TrescaSmooth{0.1, 1.5}).check("belt"), InputError);
}

/// Each node that slips is dragged by what the law says at its own pressure.
TEST(TrescaSmooth, DragsByThePressure) {
  const double flow_stress = 30.0, shear = 0.6 * flow_stress / std::numbers::sqrt3;
  Masses scene = block_on_a_belt(flow_stress, law);
  const double dt = 1e-3;
  for (int i = 0; i < 5; ++i) scene.step(dt);
  int pressed = 0;
  const auto [low, high] = std::minmax_element(scene.x[0].begin(), scene.x[0].end());
  const double first = *low, last = *high;
  for (const BoundaryNodeIndex b : scene.contact->boundary_nodes().indices()) {
    const Vec2& impulse = scene.contact->nodal_impulse()[b];
    const double x = scene.position(as<int>(scene.contact->boundary_nodes()[b])).x();
    const double area = x > first + 0.05 && x < last - 0.05 ? 0.1 : 0.05; // an edge, at the ends half of one
    const double normal = impulse.y() / dt, sliding = impulse.x() / dt;
    if (normal <= 0.0) continue;
    ++pressed;
    const double known = shear * area * (1.0 - std::exp(-0.5 * normal / (shear * area)));
    EXPECT_NEAR(sliding, known, 1e-3 * known) << "pressed by " << normal << " N/m";
    EXPECT_LT(sliding, 0.9 * std::min(0.5 * normal, shear * area)) << "visibly below the other law";
  }
  EXPECT_EQ(pressed, 6);
}

TEST(TrescaSmooth, EndsInTheLawsItJoins) {
  Masses soft = block_on_a_belt(0.3, law), hard = block_on_a_belt(3e4, law);
  const double strength = 0.6 * 0.3 / std::numbers::sqrt3 * 0.5; // on five edges
  EXPECT_NEAR(drag(soft), strength, 0.02 * strength);
  EXPECT_NEAR(drag(hard), 0.5 * 9.81, 0.02 * 0.5 * 9.81);
}
