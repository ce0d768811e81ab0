#include "report/removal_page.hpp"

#include <gtest/gtest.h>

namespace cnem::report {

TEST(RemovalPage, ShowsPointsDeviationsAndEnergies) {
  const results::HistoryTable history{{"time[s]", "tool[m]", "P.ux[m]", "P.uy[m]", "P.uz[m]",
                                       "P.deviation[m]", "energy.work[J]", "energy.chips[J]", "iterations"},
                                      {{0.0, 1.0},
                                       {0.0, 0.1},
                                       {0.0, 0.0},
                                       {0.0, -2e-6},
                                       {0.0, 1e-6},
                                       {0.0, 3e-9},
                                       {0.0, 5.0},
                                       {0.0, 1.0},
                                       {1, 2}}};
  const std::vector<Chart> charts = removal_charts(history);
  ASSERT_EQ(charts.size(), 3U);
  ASSERT_EQ(charts[0].series.size(), 2U)
      << "one that goes backwards alone is a motion, one that rests is none";
  EXPECT_EQ(charts[0].series[0].label, "P.uy");
  EXPECT_EQ(charts[0].series[0].y, (std::vector<double>{0.0, -2e-6}));
  ASSERT_EQ(charts[1].series.size(), 1U);
  EXPECT_EQ(charts[1].series[0].label, "P");
  EXPECT_EQ(charts[2].series.size(), 2U);
  EXPECT_TRUE(removal_charts({{"time[s]", "energy.work[J]"}, {{0.0, 1.0}, {0.0, 1.0}}}).empty());
}

} // namespace cnem::report
