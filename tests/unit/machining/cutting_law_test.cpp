// Cutting laws at single points.
#include "machining/cutting_law.hpp"

#include "core/error.hpp"
#include "machining/cutter.hpp"
#include "tests/degree.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::machining {
namespace {

/// Ti6Al4V at a rake of 12°: r = (1.755 − 0.028α) h^(0.331 − 0.0082α), β = 19.1° + 0.29α.
ObliqueLaw titanium(double inclination) {
  ObliqueLaw law;
  law.shear_stress = 613e6;
  law.rake = 12.0 * degree;
  law.friction_angle = (19.1 + 0.29 * 12.0) * degree;
  law.chip_ratio = 1.755 - 0.028 * 12.0;
  law.chip_ratio_exponent = 0.331 - 0.0082 * 12.0;
  law.inclination = inclination;
  return law;
}

TEST(Oblique, FromOrthogonalData) {
  const Vec3 straight = titanium(0.0).pressures(1e-4) / 1e6,
             inclined = titanium(30.0 * degree).pressures(1e-4) / 1e6;
  EXPECT_NEAR(straight[0], 1501.6, 0.1);
  EXPECT_NEAR(straight[1], 280.5, 0.1);
  EXPECT_NEAR(straight[2], 0.0, 1e-9);
  EXPECT_NEAR(inclined[0], 1503.5, 0.1);
  EXPECT_NEAR(inclined[1], 213.6, 0.1);
  EXPECT_NEAR(inclined[2], 512.7, 0.1);
}

TEST(Oblique, TakesTheHelixWhereItDoesNotSay) {
  CuttingLaw law(titanium(infinite)), given(titanium(0.1));
  law.incline(30.0 * degree);
  given.incline(30.0 * degree);
  EXPECT_NEAR(law.at({.thickness = 1e-4}).force[2], 512.7e6 * 1e-4, 10.0);
  EXPECT_LT(given.at({.thickness = 1e-4}).force[2], 300e6 * 1e-4);
}

template<class Law> void expect_slope(const Law& law, double h) {
  const CuttingLaw any(law);
  const double d = 1e-4 * h;
  const Vec3 difference =
      (any.at({.thickness = h + d, .speed = 2.5}).force - any.at({.thickness = h - d, .speed = 2.5}).force) /
      (2.0 * d);
  EXPECT_LT((any.at({.thickness = h, .speed = 2.5}).slope - difference).norm(), 1e-6 * difference.norm());
}

KienzleLaw steel() {
  KienzleLaw law;
  law.Kt1 = 1.8e9;
  law.Kr1 = 0.6e9;
  law.Ka1 = 0.3e9;
  law.mt = 0.25;
  law.mr = 0.4;
  law.ma = 0.3;
  return law;
}

TableLaw table() {
  TableLaw law;
  law.thickness = {{1e-5, 5e-5, 1e-4}, 3};
  law.speed = {{2.0, 4.0}, 2};
  law.Ft = {{1e4, 3e4, 5e4, 0.8e4, 2.6e4, 4.4e4}, 6};
  law.Fr = {{0.9e4, 1e4, 1.1e4, 0.9e4, 1e4, 1.1e4}, 6};
  return law;
}

TEST(CuttingLaws, SlopesAreDerivatives) {
  LinearLaw linear;
  linear.Ktc = 7e8;
  linear.Kre = 1e4;
  expect_slope(linear, 3e-5);
  expect_slope(steel(), 3e-5);
  expect_slope(titanium(0.5), 3e-5);
  expect_slope(table(), 3e-5);
  expect_slope(table(), 3e-4);
  EXPECT_TRUE(CuttingLaw(linear).linear());
  EXPECT_FALSE(CuttingLaw(steel()).linear());
}

TEST(CuttingLaws, KienzleAtAMillimetre) {
  const LawPoint point = CuttingLaw(steel()).at({.thickness = 1e-3});
  EXPECT_NEAR(point.force[0], 1.8e6, 1e-6);
  EXPECT_NEAR(CuttingLaw(steel()).at({.thickness = 1e-4}).force[0], 1.8e6 * std::pow(0.1, 0.75), 1e-6);
}

TEST(CuttingLaws, TableBetweenItsPoints) {
  const CuttingLaw law(table());
  EXPECT_NEAR(law.at({.thickness = 3e-5, .speed = 3.0}).force[0], 0.5 * (2e4 + 1.7e4), 1e-9);
  EXPECT_NEAR(law.at({.thickness = 5e-6, .speed = 2.0}).force[0], 0.5e4, 1e-9) << "from the origin";
  EXPECT_NEAR(law.at({.thickness = 2e-4, .speed = 9.0}).force[0], 8e4, 1e-9) << "the last slope";
  EXPECT_EQ(law.at({.thickness = 3e-5, .speed = 3.0}).force[2], 0.0);
  EXPECT_EQ(law.known().thickness.high, 1e-4);
  EXPECT_EQ(law.known().speed.low, 2.0);
  EXPECT_FALSE(law.known().rake.bounded());
}

TEST(CuttingLaws, TableOverRakes) {
  TableLaw law = table();
  law.rakes = {{-0.1, 0.2}, 2};
  law.Ft.size = law.Fr.size = 12;
  for (int k = 0; k < 6; ++k) {
    law.Ft.value[6 + k] = 0.5 * law.Ft.value[k];
    law.Fr.value[6 + k] = 0.2 * law.Fr.value[k];
  }
  const Cut cut{.thickness = 3e-5, .speed = 3.0};
  const auto of = [&](double rake) {
    CuttingLaw any(law);
    EXPECT_TRUE(any.known().several_rakes());
    any.take_rake(rake);
    EXPECT_FALSE(any.known().several_rakes());
    return any.at(cut).force;
  };
  const Vec3 first = CuttingLaw(table()).at(cut).force;
  EXPECT_NEAR(of(-0.1)[0], first[0], 1e-9);
  EXPECT_NEAR(of(0.2)[0], 0.5 * first[0], 1e-9);
  EXPECT_NEAR(of(0.05)[1], 0.6 * first[1], 1e-9) << "halfway";
  EXPECT_NEAR(of(1.0)[1], 0.2 * first[1], 1e-9) << "constant beyond";
  law.Fr.size = 6;
  EXPECT_THROW(CuttingLaw{law}, InputError);
}

TEST(CuttingLaws, TablesThatDoNotFitAreRefused) {
  TableLaw few = table(), falling = table();
  few.Ft.size = 3;
  falling.thickness.value[1] = 1e-6;
  EXPECT_THROW(CuttingLaw{few}, InputError);
  EXPECT_THROW(CuttingLaw{falling}, InputError);
}

TEST(Cutter, TeethLagAndStandOut) {
  Cutter cutter{.diameter = 12e-3, .pitch = {1.5, 2.0, 2.0 * std::numbers::pi - 3.5}, .helix = 30.0 * degree};
  EXPECT_NEAR(cutter.lag(6e-3), std::tan(30.0 * degree), 1e-12);
  EXPECT_NEAR(cutter.behind(2), 3.5, 1e-12);
  EXPECT_NEAR(cutter.pitch_before(1), 1.5, 1e-12);
  EXPECT_EQ(cutter.pattern(), 3U);
  cutter.run_out = 5e-6;
  EXPECT_NEAR(cutter.radius_of(0), 6e-3 + 5e-6, 1e-15);
  EXPECT_EQ((Cutter{.diameter = 1.0, .pitch = {1.0, 2.0, 1.0, 2.0 * std::numbers::pi - 4.0}}.pattern()), 4U);
  EXPECT_EQ((Cutter{.diameter = 1.0, .pitch = equal_pitch(4)}.pattern()), 1U);
}

TEST(Engagement, FromSideAndDepth) {
  const Cutter cutter{.diameter = 12e-3, .pitch = equal_pitch(2)};
  const Engagement up{Engagement::Side::up, 3e-3}, down{Engagement::Side::down, 3e-3};
  EXPECT_NEAR(up.entry(cutter), 0.0, 1e-15);
  EXPECT_NEAR(up.exit(cutter), 60.0 * degree, 1e-12);
  EXPECT_NEAR(down.entry(cutter), 120.0 * degree, 1e-12);
  EXPECT_NEAR(down.exit(cutter), 180.0 * degree, 1e-12);
}

} // namespace
} // namespace cnem::machining
