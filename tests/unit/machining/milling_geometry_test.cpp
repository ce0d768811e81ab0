// What cutters remove and leave, and the power that takes.
#include "machining/milling_process.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

using enum Engagement::Side;

TEST(Milling, ChipsAreWhatDexelsLose) {
  struct Row {
    Engagement::Side side;
    double immersion, run_out, corner;
    std::vector<Mode> modes;
  };
  for (const Row& row : {Row{down, 0.5, 0.0, 0.0, {}}, Row{up, 0.1, 2e-5, 0.0, insperger_modes(2)},
                         Row{down, 1.0, 0.0, 6e-3, insperger_modes(1)}}) {
    MillingCut cut = milling_cut(3, 767e6, 0.0, row.side, row.immersion);
    cut.cutter.helix = std::numbers::pi / 6.0;
    cut.cutter.pitch = {1.8, 2.2, full_turn - 4.0};
    cut.cutter.run_out = row.run_out;
    cut.cutter.corner = row.corner;
    MillingProcess process(
        cut, row.modes,
        {.spindle = 800.0, .axial_depth = 2e-3, .length = 1.5e-3, .pitch = 1e-4, .layers = 4, .steps = 360});
    const double whole = process.volume();
    double removed = 0.0, work = 0.0;
    while (!process.at_end()) {
      const ProcessStep step = process.advance();
      removed += step.removed;
      work += step.power * full_turn / 800.0 / 360.0;
    }
    const double lost = whole - process.volume();
    EXPECT_NEAR(removed / lost, 1.0, 1e-12 * whole / lost);
    EXPECT_NEAR(work / (767e6 * lost), 1.0, 1e-10) << "all work goes into the chips";
  }
}

TEST(Milling, PowerIsThatOfTheRemovalRate) {
  for (const Engagement::Side side : {up, down})
    for (const double immersion : {0.05, 0.5, 1.0}) {
      const MillingCut cut = milling_cut(3, 767e6, 168.8e6, side, immersion);
      MillingProcess process(cut, {},
                             {.spindle = 800.0,
                              .axial_depth = 1e-3,
                              .length = 2.7e-3,
                              .pitch = 1e-4,
                              .layers = 1,
                              .steps = 720});
      double power = 0.0;
      while (!process.at_end()) {
        const ProcessStep step = process.advance();
        if (step.angle > 4.0 * full_turn) power += step.power / (5.0 * 720.0);
      }
      const double rate = 1e-3 * cut.engagement.radial_depth * process.feed_of_turn() * 800.0 / full_turn;
      EXPECT_NEAR(power / (767e6 * rate), 1.0, 2e-4) << immersion;
    }
}

TEST(Milling, LayersThatABallDoesNotReachHaveNoSurface) {
  MillingCut cut = milling_cut(3, 767e6, 0.0, down, 1.0);
  cut.cutter.corner = cut.cutter.radius();
  cut.engagement = {down, 1e-3};
  const MillingProcess process(cut, {},
                               {.spindle = 800.0,
                                .axial_depth = cut.cutter.radius(),
                                .length = 1e-3,
                                .pitch = 0.1e-3,
                                .layers = 10,
                                .steps = 90});
  for (std::size_t k = 0; k < 10; ++k) { // by the middle height, where the profile is 1 mm inside of the side
    const double rise = cut.cutter.radius() - process.height(k);
    const double reach = std::sqrt(cut.cutter.radius() * cut.cutter.radius() - rise * rise);
    if (std::abs(reach - (cut.cutter.radius() - 1e-3)) < 0.3e-3) continue; // means of a layer
    EXPECT_EQ(process.cuts(k), reach > cut.cutter.radius() - 1e-3) << k;
  }
}

TEST(Milling, PowerOfTheThinnestChipsIsFinite) {
  const MillingCut cut = milling_cut(1, 767e6, 0.0, down, 1.0);
  const EdgeElements edges(cut, slices(1e-3, 1e-3), 0.0, full_turn / 360.0);
  EdgeLoad load;
  edges.add(load, 0, 0, {.area = 1e-24, .begin = 0.0, .end = 1.0}, Vec3(1e-4, 0.0, 0.0), 1e-5, {}, {});
  EXPECT_TRUE(std::isfinite(load.power)) << load.power;
  EXPECT_NEAR(load.power, load.torque / cut.cutter.radius() * 1e-4 / 1e-5, 1e-9 * load.power);
}

TEST(Milling, VolumesOfSlotSideAndBall) {
  MillingCut cut = milling_cut(3, 767e6, 0.0, down, 1.0);
  const auto removed = [&](double depth, double length, int layers) {
    MillingProcess process(cut, {},
                           {.spindle = 800.0,
                            .axial_depth = depth,
                            .length = length,
                            .dwell = 1.0,
                            .start = ProcessSettings::Start::hole,
                            .pitch = cut.cutter.diameter / 200.0,
                            .layers = layers,
                            .steps = 360});
    while (!process.at_end()) process.advance();
    return 1e9 * (process.block() - process.volume());
  };
  EXPECT_NEAR(removed(5e-3, 30e-3, 1) / 2365.487, 1.0, 2e-4);
  cut.engagement = {down, 1e-3};
  EXPECT_NEAR(removed(18e-3, 60e-3, 1) / 1161.028, 1.0, 2e-4);
  cut.cutter.diameter = 10e-3;
  cut.engagement = {down, 10e-3};
  cut.cutter.corner = 5e-3;
  EXPECT_NEAR(removed(1.5e-3, 10e-3, 20) / (253.433 - 20.0 * 7.38748), 1.0, 3e-4);
  // A bull end: section and solid of revolution of an arc of 2 mm below a side of 5 mm, 3 mm deep.
  cut.cutter.corner = 2e-3;
  const double section = 2.0 * (3.0 * 2.0 + std::numbers::pi + 5.0 * 1.0);
  const double hole = std::numbers::pi * (9.0 * 2.0 + 6.0 * std::numbers::pi + 16.0 / 3.0 + 25.0);
  EXPECT_NEAR(removed(3e-3, 4e-3, 24) / (section * 4.0 + hole), 1.0, 3e-4);
}

TEST(Milling, Scallops) {
  for (const auto& [side, height] : {std::pair{down, 0.09283e-3}, {up, 0.05183e-3}}) {
    MillingCut cut = milling_cut(3, 767e6, 0.0, side, 1.0 / 6.0);
    cut.feed = 1.8e-3;
    MillingProcess process(
        cut, {},
        {.spindle = 800.0, .axial_depth = 1e-3, .length = 20e-3, .pitch = 4e-6, .layers = 1, .steps = 2880});
    while (!process.at_end()) process.advance();
    double low = 1.0, high = -1.0;
    for (double x = 6e-3; x < 13e-3; x += 4e-6) {
      low = std::min(low, process.left_at(0, x).value());
      high = std::max(high, process.left_at(0, x).value());
    }
    EXPECT_NEAR(high - low, height, 0.01 * height);
  }
}

} // namespace
} // namespace cnem::machining
