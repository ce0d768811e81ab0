#include "voronoi/exact.hpp"

#include "tests/clouds.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace cnem::voronoi::test {
namespace {

/// Points of a small lattice, a few units in the last place off: lines and circles pass through many.
Vec2 near_lattice(cnem::testing::Random& random, double off) {
  constexpr double unit = std::numeric_limits<double>::epsilon();
  const auto place = [&] {
    const double whole = 1.0 + std::floor(random.uniform(0.0, 4.0));
    return 1e-5 * whole * (1.0 + off * unit * std::floor(random.uniform(-2.0, 3.0)));
  };
  return {place(), place()};
}

TEST(Exact, WhatRoundingDecidesIsRight) {
  cnem::testing::Random random(1);
  int in_doubt = 0;
  for (const double off : {0.0, 1.0, 100.0, 1e9})
    for (int k = 0; k < 20000; ++k) {
      const Vec2 a = near_lattice(random, off), b = near_lattice(random, off), c = near_lattice(random, off),
                 d = near_lattice(random, off);
      const int turn = orientation_in_doubt(a, b, c);
      in_doubt += turn == 0;
      ASSERT_EQ(orientation(a, b, c), turn);
      if (turn > 0) { ASSERT_EQ(in_circle(a, b, c, d), in_circle_in_doubt(a, b, c, d)); }
    }
  EXPECT_GT(in_doubt, 1000);
}

TEST(Exact, ProductsThatVanishAreLeftToTheOther) {
  const double tiny = 1e-200;
  const Vec2 a(0.0, 0.0), b(tiny, 0.0), c(tiny, tiny), d(0.0, tiny), inside(0.5 * tiny, 0.5 * tiny);
  EXPECT_EQ(orientation(a, b, c), 1);
  EXPECT_EQ(orientation(a, c, b), -1);
  EXPECT_TRUE(in_circle(a, b, c, inside));
  EXPECT_NE(in_circle(a, b, c, d), in_circle(b, c, d, a)); // one pair of opposite corners is outside
}

} // namespace
} // namespace cnem::voronoi::test
