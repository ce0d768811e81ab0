// Cuts in closed form.
#include "evaluate/shear_zone.hpp"

#include "evaluate/material_point.hpp"
#include "plasticity/hardening_laws.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <vector>

namespace cnem::evaluate {
namespace {

constexpr double one_degree = std::numbers::pi / 180.0;

plasticity::Material perfect(double yield) {
  plasticity::Material material;
  material.density = 2700.0;
  plasticity::Perfect law;
  law.yield = yield;
  material.hardening = plasticity::Hardening(law);
  return material;
}

plasticity::Material johnson_cook() {
  plasticity::Material material;
  material.density = 7800.0;
  material.specific_heat = 480.0;
  material.conductivity = 40.0;
  plasticity::JohnsonCook law;
  law.A = 550e6;
  law.B = 600e6;
  law.n = 0.25;
  law.C = 0.013;
  law.m = 1.0;
  law.rate0 = 1.0;
  law.T0 = 293.15;
  law.Tmelt = 1733.0;
  material.hardening = plasticity::Hardening(law);
  return material;
}

TEST(ShearZone, OfPerfectMetalSolvesOxleysEquation) {
  const ShearZoneCut cut{.feed = 0.3e-3, .speed = 13.0, .rake = 17.5 * one_degree};
  const auto zone = shear_zone(perfect(440e6), cut);
  ASSERT_TRUE(zone);
  const double phi = zone->shear_angle, theta = phi - cut.rake, k = 440e6 / std::numbers::sqrt3;
  EXPECT_NEAR(std::tan(theta), 1.0 + 2.0 * (0.25 * std::numbers::pi - phi), 1e-9);
  EXPECT_NEAR(zone->Fc, k * cut.feed * std::cos(cut.rake) / (std::sin(phi) * std::cos(theta)),
              1e-6 * zone->Fc);
  EXPECT_NEAR(zone->Ft / zone->Fc, -std::tan(cut.rake), 1e-9) << "no friction draws the tool in";
  EXPECT_NEAR(zone->chip_thickness, cut.feed * std::cos(theta) / std::sin(phi), 1e-12);
  EXPECT_NEAR(zone->Fc / cut.feed, 386e6, 0.05 * 386e6) << "Lee and Shaffer";
  EXPECT_EQ(zone->temperature, cut.temperature) << "no heat";
}

TEST(ShearZone, WorkOfTheForceIsThatOfZoneAndFriction) {
  const ShearZoneCut cut{.feed = 0.2e-3, .speed = 3.0, .rake = 5.0 * one_degree, .friction = 0.5};
  const auto zone = shear_zone(johnson_cook(), cut);
  ASSERT_TRUE(zone);
  const double phi = zone->shear_angle, ratio = cut.feed / zone->chip_thickness;
  const double shear_speed = std::cos(cut.rake) / std::cos(phi - cut.rake);
  const double in_plane = zone->Fc * std::cos(phi) - zone->Ft * std::sin(phi);
  const double along_rake = zone->Fc * std::sin(cut.rake) + zone->Ft * std::cos(cut.rake);
  const double normal = zone->Fc * std::cos(cut.rake) - zone->Ft * std::sin(cut.rake);
  EXPECT_NEAR(zone->Fc, in_plane * shear_speed + along_rake * ratio, 1e-9 * zone->Fc);
  EXPECT_NEAR(along_rake / normal, cut.friction, 1e-9);
  EXPECT_NEAR(in_plane, zone->flow_stress / std::numbers::sqrt3 * cut.feed / std::sin(phi), 1e-9 * in_plane);
}

TEST(ShearZone, TemperatureIsThatOfItsWork) {
  const ShearZoneCut cut{.feed = 0.2e-3, .speed = 3.0, .rake = 5.0 * one_degree, .friction = 0.5};
  plasticity::Material insulating = johnson_cook();
  insulating.conductivity = 0.0;
  const auto zone = shear_zone(insulating, cut);
  ASSERT_TRUE(zone);
  // Twice the strain up to the plane, at the stress there.
  const double work = 2.0 * zone->strain * zone->flow_stress;
  EXPECT_NEAR(zone->temperature - cut.temperature,
              insulating.taylor_quinney * work / (insulating.density * insulating.specific_heat), 1e-6);
  EXPECT_NEAR(zone->flow_stress, flow_stress_of(insulating, zone->strain, zone->rate, zone->temperature),
              1.0);
  EXPECT_LT(shear_zone(johnson_cook(), cut)->temperature, zone->temperature)
      << "some goes into the workpiece";
}

TEST(ShearZone, FrictionMakesChipsThickerAndHeatForcesSmaller) {
  const auto of = [](double friction, double speed) {
    return *shear_zone(johnson_cook(), {.feed = 0.2e-3, .speed = speed, .rake = 0.0, .friction = friction});
  };
  EXPECT_GT(of(0.6, 3.0).chip_thickness, of(0.3, 3.0).chip_thickness);
  EXPECT_GT(of(0.6, 3.0).Fc, of(0.3, 3.0).Fc);
  EXPECT_LT(of(0.5, 5.0).Fc, of(0.5, 1.0).Fc);
}

/// At very small angles it hardens by more than its plane can bear, as n = 0.448 is approached: Oxley's
/// equation has a second root there, beside that of the chip.
plasticity::Material aluminium() {
  plasticity::Material material;
  material.density = 2770.0;
  material.specific_heat = 875.0;
  material.conductivity = 120.0;
  plasticity::JohnsonCook law;
  law.A = 411e6;
  law.B = 339.5e6;
  law.n = 0.448;
  law.C = 0.0058;
  law.m = 1.5;
  law.rate0 = 1.0;
  law.T0 = 293.0;
  law.Tmelt = 775.0;
  material.hardening = plasticity::Hardening(law);
  return material;
}

std::optional<ShearZone> cut_aluminium(double friction) {
  return shear_zone(aluminium(),
                    {.feed = 0.1e-3, .speed = 1.0, .rake = 0.0, .friction = friction, .temperature = 293.0});
}

TEST(ShearZone, HardeningThatMakesASecondRootKeepsTheChip) {
  std::vector<double> angles;
  for (const double friction : {0.53, 0.54, 0.55, 0.56, 0.57}) {
    const auto zone = cut_aluminium(friction);
    ASSERT_TRUE(zone) << friction;
    angles.push_back(zone->shear_angle / one_degree);
  }
  for (std::size_t k = 1; k < angles.size(); ++k) {
    EXPECT_LT(angles[k], angles[k - 1]);
    EXPECT_NEAR(angles[k - 1] - angles[k], angles[0] - angles[1], 0.1) << "no jump to the other root";
  }
}

/// Two roots meet at a friction beyond which there is no chip, and near it the angle goes as the root of what
/// is missing to it: however near they are the larger one is found.
TEST(ShearZone, RootsThatMeetAreFoundUntilTheyDo) {
  double some = 0.57, none = 2.0;
  ASSERT_TRUE(cut_aluminium(some));
  ASSERT_FALSE(cut_aluminium(none));
  for (int k = 0; k < 60; ++k) (cut_aluminium(0.5 * (some + none)) ? some : none) = 0.5 * (some + none);
  const auto angle = [&](double missing) { return cut_aluminium(some - missing)->shear_angle; };
  const double last = angle(0.0);
  EXPECT_NEAR((angle(4e-6) - last) / (angle(1e-6) - last), 2.0, 0.05);
  EXPECT_NEAR((angle(4e-5) - last) / (angle(1e-5) - last), 2.0, 0.1);
  EXPECT_LT(angle(1e-5) - last, 0.25 * one_degree) << "the other root is as far on the other side";
}

} // namespace
} // namespace cnem::evaluate
