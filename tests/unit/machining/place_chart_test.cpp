// Limits along a path on which modes change.
#include "machining/stability.hpp"
#include "tests/unit/machining/benchmarks.hpp"

#include <gtest/gtest.h>

namespace cnem::machining {
namespace {

NumberList list(std::initializer_list<double> values) {
  NumberList numbers;
  for (const double value : values) numbers.value[numbers.size++] = value;
  return numbers;
}

TEST(PlaceChart, LimitsAreThoseOfTheModesAtThePlace) {
  const MillingCut cut = insperger(Engagement::Side::up, 0.5);
  std::vector<Mode> modes = insperger_modes(1);
  const double spindle = 5000.0 * rpm;
  modes[0].along = list({0.0, 0.1, 0.2});
  modes[0].shape_along = list({0.0, 0.5, 1.0});
  modes[0].frequency_along = list({1.0, 1.0, 0.9});
  const std::vector<double> places{0.0, 0.1, 0.15, 0.2};
  std::vector<std::vector<Mode>> there;
  for (const double place : places)
    there.push_back(modes[0].moves_at(place) ? std::vector{modes[0].at(place)} : std::vector<Mode>{});
  const PlaceChart chart = place_chart(cut, there, places, spindle, 2.0 * spindle, 2, 3e-3, 40);
  ASSERT_EQ(chart.limit.size(), 8U);
  EXPECT_FALSE(chart.limit[0]) << "nothing moves there";
  // Half the motion: four times the stiffness and the mass, so that it bears four times the depth.
  EXPECT_NEAR(chart.limit[2]->depth, 4.0 * 0.2603e-3, 2e-6);
  // Slower by a tenth, of the same mass: the lobes of a spindle that is faster by a ninth, of 0.81 of the
  // stiffness.
  Mode slower = insperger_modes(1)[0];
  slower.frequency *= 0.9;
  slower.stiffness *= 0.81;
  const auto limit = depth_limit(cut, std::array{slower}, spindle, 3e-5, 3e-3);
  EXPECT_NEAR(chart.limit[6]->depth, limit->depth, 1e-6 * limit->depth);
  EXPECT_EQ(chart.weakest(spindle), 3U);
}

} // namespace
} // namespace cnem::machining
