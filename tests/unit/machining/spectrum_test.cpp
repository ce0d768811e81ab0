// Spectra of made-up signals, growth of made-up disturbances, and both of cuts against Floquet's multipliers.
#include "machining/cut_vibration.hpp"

#include "machining/milling_process.hpp"
#include "machining/stability.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cnem::machining {
namespace {

constexpr double spindle = 500.0; // rad/s

Cutter three_teeth() {
  Cutter cutter;
  cutter.diameter = 12e-3;
  cutter.pitch = equal_pitch(3);
  return cutter;
}

double sine(double amplitude, double hertz, double t) {
  return amplitude * std::sin(full_turn * hertz * t + 0.3);
}

TEST(Spectrum, FindsTheSineBesideHarmonicsAndNoise) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 2e-8);
  constexpr int steps = 360, turns = 40;
  const double dt = full_turn / spindle / steps, tooth = 3.0 * spindle / full_turn;
  for (const double chatter : {812.37, 1043.0, 611.9}) {
    CutVibration vibration(three_teeth(), steps);
    for (int k = 0; k < turns * steps; ++k) {
      const double t = dt * k;
      double forced = 5e-6;
      for (int m = 1; m < 8; ++m) forced += sine(4e-6 / m, m * tooth, t);
      vibration.add(Vec3(100.0 + sine(30.0, tooth, t), 0.0, 0.0),
                    Vec3(forced + noise(random), sine(1.7e-6, chatter, t), 0.0));
    }
    EXPECT_EQ(vibration.period(), steps / 3);
    EXPECT_NEAR(vibration.base(spindle), tooth, 1e-9);
    const auto peak = vibration.chatter(spindle);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(peak->frequency, chatter, 1e-4 * chatter);
    EXPECT_NEAR(peak->amplitude, 1.7e-6, 1e-8);
    const auto force = vibration.spectrum(CutVibration::Fx, spindle);
    ASSERT_TRUE(force);
    const auto line = static_cast<std::size_t>(std::lround(tooth / force->step));
    EXPECT_NEAR(force->amplitude[line], 30.0, 1e-9) << "a tooth's harmonic falls on a line";
    EXPECT_NEAR(force->amplitude[0], 0.0, 1e-9) << "without the mean";
  }
}

TEST(Spectrum, RunOutMakesHarmonicsOfTheSpindle) {
  Cutter cutter = three_teeth();
  cutter.run_out = 1e-5;
  EXPECT_EQ(CutVibration(cutter, 360).period(), 360);
  cutter.run_out = 0.0;
  cutter.pitch = {2.0, 2.0, full_turn - 4.0};
  EXPECT_EQ(CutVibration(cutter, 360).period(), 360);
  cutter.pitch = equal_pitch(7);
  EXPECT_EQ(CutVibration(cutter, 360).period(), 360) << "no whole number of samples";
}

TEST(Spectrum, GrowthOfADisturbanceOnForcedVibration) {
  constexpr int steps = 360;
  for (const double factor : {0.8, 0.99, 1.05}) {
    CutVibration vibration(three_teeth(), steps);
    for (int k = 0; k < 20 * steps; ++k) {
      const double periods = k / 120.0;
      vibration.add(Vec3::Zero(), Vec3(sine(1e-5, 1.0, periods),
                                       1e-8 * std::pow(factor, periods) * std::sin(2.0 * periods), 0.0));
    }
    const auto growth = vibration.growth();
    ASSERT_TRUE(growth);
    EXPECT_NEAR(growth->factor, factor, 0.003 * factor);
    EXPECT_NEAR(growth->vibration, 1e-5 / std::sqrt(2.0), 1e-7);
  }
}

TEST(Spectrum, NothingIsSaidOfShortOrStillCuts) {
  CutVibration vibration(three_teeth(), 36);
  for (int k = 0; k < 71; ++k) vibration.add(Vec3::Zero(), Vec3(k % 12, 0.0, 0.0));
  EXPECT_FALSE(vibration.growth()) << "fewer than six periods";
  EXPECT_FALSE(vibration.spectrum(CutVibration::x, spindle)) << "less than two turns";
  vibration.add(Vec3::Zero(), Vec3(11.0, 0.0, 0.0));
  EXPECT_FALSE(vibration.growth()) << "each period is as the one before";
  EXPECT_TRUE(vibration.spectrum(CutVibration::x, spindle));
}

struct FloquetRow {
  Engagement::Side side;
  double immersion, speed, limit; ///< –, rpm, m
  bool flip;
};

TEST(Spectrum, ChatterOfDexelsIsThatOfFloquet) {
  using enum Engagement::Side;
  for (const FloquetRow& row :
       {FloquetRow{up, 0.5, 5000.0, 0.2603e-3, false}, FloquetRow{up, 0.5, 8000.0, 0.4060e-3, false},
        FloquetRow{down, 0.5, 7000.0, 2.5506e-3, false}, FloquetRow{down, 0.1, 7000.0, 2.9878e-3, true}}) {
    MillingCut cut = insperger(row.side, row.immersion);
    cut.feed = 1e-5;
    constexpr int steps = 720, turns = 80;
    const double depth = 1.03 * row.limit;
    MillingProcess process(cut, insperger_modes(1),
                           {.spindle = row.speed * rpm,
                            .axial_depth = depth,
                            .length = turns * 2.0 * cut.feed,
                            .pitch = 1e-6,
                            .layers = 1,
                            .steps = steps});
    CutVibration vibration(cut.cutter, steps);
    while (!process.at_end()) {
      const ProcessStep step = process.advance();
      if (step.angle > 0.5 * turns * full_turn) vibration.add(step.force, step.displacement);
    }
    const Multiplier floquet = multiplier(cut, insperger_modes(1), row.speed * rpm, depth);
    EXPECT_EQ(floquet.kind(), row.flip ? Bifurcation::flip : Bifurcation::hopf);
    const auto peak = vibration.chatter(row.speed * rpm);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(peak->frequency / floquet.frequency, 1.0, 0.005) << row.speed;
    const auto growth = vibration.growth();
    ASSERT_TRUE(growth);
    EXPECT_GT(growth->factor, 1.0);
  }
}

} // namespace
} // namespace cnem::machining
