// Carrying values over parcels: what stays to the bit.
#include "core/operators/parcels.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace cnem {
namespace {

using namespace testing::literals;

const NodeRows halves{{0, 1, 3}, {0_node, 1_node, 2_node}, {1.0, 0.5, 0.5}};
const Field mass{1.0, 2.0, 6.0};

TEST(Parcels, equal_values_keep_their_bits_infinite_ones_too) {
  const double never = std::numeric_limits<double>::infinity(); // the flow stress of elastic matter
  Field tenth(3, 0.1), infinite(3, never);
  carry_mean(halves, mass, tenth);
  carry_mean(halves, mass, infinite);
  EXPECT_EQ(tenth, (Field{0.1, 0.1}));
  EXPECT_EQ(infinite, (Field{never, never}));
}

TEST(Parcels, means_lie_among_their_values_however_small_a_share_is) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  const NodeRows pair{{0, 2}, {0_node, 1_node}, {1.0, 1.0}};
  int near = 0; // means that rounding alone could take below 0
  for (int k = 0; k < 1000; ++k) {
    Field rate{1e6 * uniform(random), 0.0};
    carry_mean(pair, {1e-20 * uniform(random), uniform(random)}, rate);
    EXPECT_GE(rate[0], 0.0);
    if (rate[0] < 1e-9) ++near;
  }
  EXPECT_GT(near, 900);
}

TEST(Parcels, rows_of_points_are_those_of_their_nodes) {
  const PointRows points = rows_of_points(halves);
  EXPECT_EQ(points.begin, halves.begin);
  EXPECT_EQ(points.weight, halves.weight);
  EXPECT_EQ(points.from, (std::vector<PointIndex>{PointIndex{0}, PointIndex{1}, PointIndex{2}}));
  EXPECT_FALSE(points.mixed(0));
  EXPECT_TRUE(points.mixed(1));
  Field value{1.0, 2.0, 4.0};
  carry_mean(points, mass, value);
  EXPECT_EQ(value, (Field{1.0, 3.5}));
}

} // namespace
} // namespace cnem
