// Limits, tables and melting of friction.
#include "core/error.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

Table measured() {
  Table law;
  law.coefficient = 0.4;
  law.temperature = {{300.0, 900.0, 1300.0}, 3};
  law.over_temperature = {{1.0, 0.8, 0.2}, 3};
  law.speed = {{0.0, 2.0}, 2};
  law.over_speed = {{1.0, 0.5}, 2};
  return law;
}

/// A block of 1 kg/m, three rows of six masses, on a belt that runs away; its drag, N/m.
double drag(const Friction& friction, double flow_stress, double temperature, double melting) {
  Masses scene = block(6, 3, 0.1, {0.0, 0.0}, 4e3, 10.0);
  scene.gravity = {0, -9.81};
  Tool<2> belt = tool(box({-200, -1}, {20, 0}), {50.0, 0.0});
  belt.friction = friction;
  scene.start({belt});
  const std::size_t n = scene.contact->boundary_nodes().size();
  scene.flow_stress.assign(n, flow_stress);
  scene.temperature.assign(n, temperature);
  scene.melting.assign(n, melting);
  for (int i = 0; i < 1500; ++i) scene.step(1e-3);
  const double before = scene.momentum().x();
  for (int i = 0; i < 500; ++i) scene.step(1e-3);
  return (scene.momentum().x() - before) / 0.5;
}

} // namespace

TEST(CoulombLimited, BearsTheLimitAtMost) {
  EXPECT_TRUE(std::isinf(Friction(Coulomb{0.5}).bound({}).shear));
  EXPECT_DOUBLE_EQ(Friction(Coulomb{0.5, 220e6}).bound({}).shear, 220e6);
  EXPECT_FALSE(Friction(Coulomb{0.5, 220e6}).needs_flow_stress());
  const double limit = 2.0, area = 0.5; // Pa, m: five edges
  EXPECT_NEAR(drag(Coulomb{0.5, limit}, 0.0, 300.0, infinite), limit * area, 0.02 * limit * area);
  EXPECT_NEAR(drag(Coulomb{0.5, 1e3}, 0.0, 300.0, infinite), 0.5 * 9.81, 0.02 * 0.5 * 9.81);
  EXPECT_THROW(Friction(Coulomb{0.5, -1.0}).check("belt"), InputError);
}

TEST(FrictionTable, IsItsFormula) {
  const Friction friction = measured();
  EXPECT_TRUE(friction.needs_speed());
  EXPECT_TRUE(friction.needs_flow_stress());
  const auto coefficient = [&](double temperature, double speed) {
    return friction.bound({.flow_stress = 300e6, .speed = speed, .temperature = temperature}).coefficient;
  };
  EXPECT_DOUBLE_EQ(coefficient(300.0, 0.0), 0.4);
  EXPECT_DOUBLE_EQ(coefficient(250.0, 0.0), 0.4);
  EXPECT_DOUBLE_EQ(coefficient(600.0, 0.0), 0.4 * 0.9);
  EXPECT_DOUBLE_EQ(coefficient(1200.0, 1.0), 0.4 * 0.35 * 0.75);
  EXPECT_DOUBLE_EQ(coefficient(2000.0, 9.0), 0.4 * 0.2 * 0.5);
  EXPECT_DOUBLE_EQ(friction.bound({.flow_stress = 300e6}).shear, 300e6 / std::numbers::sqrt3);
  Table limited = measured();
  limited.shear_limit = 100e6;
  EXPECT_DOUBLE_EQ(Friction(limited).bound({.flow_stress = 300e6}).shear, 100e6);
  Table plain;
  plain.coefficient = 0.4;
  EXPECT_FALSE(Friction(plain).needs_speed());
  EXPECT_DOUBLE_EQ(Friction(plain).bound({.flow_stress = 1.0, .speed = 7.0}).coefficient, 0.4);
}

TEST(FrictionTable, IsATable) {
  Table uneven = measured(), falling = measured();
  uneven.over_speed.size = 1;
  falling.temperature.value[1] = 200.0;
  EXPECT_THROW(Friction{uneven}, InputError);
  EXPECT_THROW(Friction{falling}, InputError);
}

TEST(FrictionTable, DragsByTheTemperature) {
  Table law = measured();
  law.speed.size = law.over_speed.size = 0;
  for (const double temperature : {300.0, 600.0, 1100.0}) {
    const double known = 0.4 * piecewise_linear(law.temperature, law.over_temperature, temperature) * 9.81;
    EXPECT_NEAR(drag(law, 1e6, temperature, infinite), known, 0.02 * known) << temperature;
  }
}

TEST(Melting, TakesFrictionOfEveryLawAway) {
  for (Friction friction : {Friction(Coulomb{0.3}), Friction(TrescaLimited{0.3}), Friction(TrescaSmooth{0.3}),
                            Friction(CoulombDecay{0.3, 0.2, 1.0}), Friction(measured())}) {
    const auto bound = [&](double temperature) {
      return friction.bound({.flow_stress = 1e8, .temperature = temperature, .melting = 1800.0});
    };
    const FrictionBound cold = friction.bound({.flow_stress = 1e8, .temperature = 1700.0});
    EXPECT_EQ(bound(1700.0).coefficient, cold.coefficient) << "bit for bit below the range";
    EXPECT_EQ(bound(1700.0).shear, cold.shear);
    const FrictionBound hot = friction.bound({.flow_stress = 1e8, .temperature = 1775.0});
    EXPECT_DOUBLE_EQ(bound(1775.0).coefficient, 0.25 * hot.coefficient);
    EXPECT_EQ(std::isinf(bound(1775.0).shear), std::isinf(hot.shear));
    for (const double molten : {1800.0, 2500.0}) EXPECT_EQ(bound(molten).coefficient, 0.0);
    const FrictionBound unmolten = friction.bound({.flow_stress = 1e8, .temperature = 1745.0});
    friction.set_melting({.temperature = 1760.0, .range = 20.0});
    EXPECT_EQ(bound(1760.0).coefficient, 0.0) << "what a case says goes before the material";
    EXPECT_DOUBLE_EQ(bound(1745.0).coefficient, 0.75 * unmolten.coefficient);
  }
  Friction friction = Coulomb{0.3};
  friction.set_melting({.range = 0.0});
  EXPECT_THROW(friction.check("belt"), InputError);
}

TEST(Melting, DragsLessAndLess) {
  for (const double share : {1.0, 0.6, 0.0}) {
    const double known = share * 0.3 * 9.81;
    EXPECT_NEAR(drag(Coulomb{0.3}, 0.0, 1800.0 - 100.0 * share, 1800.0), known, 0.02 * known + 1e-12)
        << share;
  }
}
