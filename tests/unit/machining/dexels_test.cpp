// Dexels against areas that are known.
#include "machining/dexels.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::machining {
namespace {

TEST(Dexels, DiscAndBoxAreTakenOnce) {
  DexelLayer layer(Vec2(0, 0), Vec2(20e-3, 10e-3), Vec2(1e-5, 1e-5));
  EXPECT_NEAR(layer.area(), 200e-6, 1e-15);
  layer.erase_disc(Vec2(10e-3, 5e-3), 4e-3);
  EXPECT_NEAR(layer.area(), 200e-6 - std::numbers::pi * 16e-6, 1e-14);
  layer.erase_disc(Vec2(10e-3, 5e-3), 3e-3);
  layer.erase_box(Vec2(-1.0, 8e-3), Vec2(1.0, 1.0));
  const double beyond = 16e-6 * std::acos(0.75) - 3e-3 * std::sqrt(7e-6); // of the disc, within the box
  EXPECT_NEAR(layer.area(), 200e-6 - 16e-6 * std::numbers::pi - 40e-6 + beyond, 1e-10);
}

/// A rake that turns about an axis.
Rake rake(const Vec2& axis, double radius, double depth, double angle) {
  const Vec2 out(std::sin(angle), std::cos(angle));
  return {axis + radius * out, axis + (radius - depth) * out};
}

TEST(Dexels, LoseWhatARakeSweeps) {
  // However wide the cells are, and however the rake lies in them.
  for (const double pitch : {7e-4, 1e-4, 1e-5}) {
    DexelLayer layer(Vec2(-7e-3, -7e-3), Vec2(7e-3, 7e-3), Vec2(pitch, 1.3 * pitch));
    double before = layer.area();
    for (int k = 0; k < 200; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 200;
      const Sweep sweep{rake(Vec2::Zero(), 6e-3, 1e-4, angle), rake(Vec2::Zero(), 6e-3, 1e-4, angle + 0.01)};
      const Bite asked = layer.ask(sweep);
      EXPECT_DOUBLE_EQ(layer.area(), before) << "to ask takes nothing";
      const Bite bite = layer.erase(sweep);
      EXPECT_DOUBLE_EQ(bite.area, asked.area);
      EXPECT_NEAR(bite.area, 0.5 * std::sin(0.01) * (36e-6 - 5.9e-3 * 5.9e-3), 1e-18);
      EXPECT_NEAR(bite.share(), 1.0, 1e-9);
      const double now = layer.area();
      EXPECT_NEAR(before - now, bite.area, 1e-18);
      EXPECT_EQ(layer.ask(sweep).area, 0.0) << "nothing is taken twice";
      before = now;
    }
  }
}

TEST(Dexels, TellWhereOnItsWayAnEdgeCuts) {
  DexelLayer layer(Vec2(0, 0), Vec2(1e-3, 1e-3), Vec2(3e-4, 3e-4));
  // Along x through the side at x = 0, a quarter of the way before it.
  const Sweep in{{Vec2(-1e-4, 9e-4), Vec2(-1e-4, 5e-4)}, {Vec2(3e-4, 9e-4), Vec2(3e-4, 5e-4)}};
  const Bite bite = layer.ask(in);
  EXPECT_NEAR(bite.area, 3e-4 * 4e-4, 1e-18);
  EXPECT_NEAR(bite.begin, 0.25, 1e-12);
  EXPECT_NEAR(bite.end, 1.0, 1e-12);
}

TEST(Dexels, HoldSeveralIntervals) {
  DexelLayer layer(Vec2(0, 0), Vec2(10e-3, 1e-3), Vec2(1e-4, 1e-4));
  layer.erase_box(Vec2(2e-3, -1.0), Vec2(3e-3, 1.0));
  layer.erase_disc(Vec2(7e-3, 0.5e-3), 0.25e-3);
  const std::vector<Interval> matter = layer.matter(0, 0.5e-3);
  ASSERT_EQ(matter.size(), 3U);
  const std::array<double, 6> ends{0.0, 2e-3, 3e-3, 6.75e-3, 7.25e-3, 10e-3};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(matter[k].low, ends[2 * k], 1e-8);
    EXPECT_NEAR(matter[k].high, ends[2 * k + 1], 1e-8);
  }
  EXPECT_TRUE(layer.matter(0, 2e-3).empty()) << "beside the box";
}

TEST(Dexels, HaveTheirMatterOnLinesOfAnyDirection) {
  // A disc of 1 mm is taken of a square: from its middle, in the corner of four cells, each line meets matter
  // from there to the side of the square.
  DexelLayer layer(Vec2(-3e-3, -3e-3), Vec2(3e-3, 3e-3), Vec2(1e-4, 1e-4));
  layer.erase_disc(Vec2::Zero(), 1e-3);
  for (int k = 0; k < 64; ++k) {
    const double angle = std::numbers::pi * k / 32;
    const Vec2 rounded(std::cos(angle), std::sin(angle)); // along the sides of cells but for rounding
    std::vector<Vec2> ways{rounded};
    if (k % 16 == 0) {
      ways.emplace_back(std::round(rounded.x()), std::round(rounded.y()));
      ways.push_back(2.0 * ways.back() - rounded);
    }
    for (const Vec2& along : ways) {
      const std::vector<Interval> matter = layer.matter(Vec2::Zero(), along, 5e-3);
      ASSERT_EQ(matter.size(), 1U) << k;
      EXPECT_NEAR(matter[0].low, 1e-3, 1e-6) << k;
      EXPECT_NEAR(matter[0].high, 3e-3 / along.cwiseAbs().maxCoeff(), 1e-15) << k;
      EXPECT_NEAR(layer.matter(Vec2::Zero(), along, 2e-3)[0].high, 2e-3, 1e-15) << "to where the line ends";
      EXPECT_TRUE(layer.matter(4.5e-3 * along, along, 1e-3).empty()) << "beside the box";
    }
  }
}

} // namespace
} // namespace cnem::machining
