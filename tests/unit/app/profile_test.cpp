// Where the time went: phases, their parts, the table.
#include "app/profile.hpp"
#include "app/stopwatch.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

double seconds(const std::vector<std::pair<std::string, double>>& list, const std::string& phase) {
  for (const auto& [name, value] : list)
    if (name == phase) return value;
  ADD_FAILURE() << "no phase " << phase;
  return -1.0;
}

TEST(Stopwatch, parts_count_to_their_phase_and_all_phases_are_listed) {
  Stopwatch watch;
  watch.add("total", 10.0);
  watch.add("step", 3.0);
  watch.add("step.contact", 1.0);
  const int result = watch.time("output", [&] { return watch.time("output.fields", [] { return 7; }); });
  EXPECT_EQ(result, 7);
  const auto list = watch.spent();
  EXPECT_GE(seconds(list, "total"), 10.0);
  EXPECT_EQ(seconds(list, "step"), 3.0);
  EXPECT_EQ(seconds(list, "step.contact"), 1.0);
  EXPECT_EQ(seconds(list, "rebuild"), 0.0);
  EXPECT_GE(seconds(list, "output"), seconds(list, "output.fields"));
  EXPECT_GT(seconds(list, "output.fields"), 0.0);
}

TEST(Profile, a_line_has_phase_seconds_share_and_time_per_node_and_step) {
  results::RunStatus status;
  status.node_steps = 1000000;
  status.wall_s = {{"total", 2.0}, {"step", 1.0}, {"step.stress", 0.25}, {"rebuild", 0.0}};
  EXPECT_EQ(profile_table(status), "phase               seconds    share ns/node-step\n"
                                   "total                2.0000   100.0%      2000.00\n"
                                   "step                 1.0000    50.0%      1000.00\n"
                                   "  stress             0.2500    12.5%       250.00\n");
}

TEST(Profile, without_steps_there_is_no_time_per_step) {
  results::RunStatus status;
  status.wall_s = {{"total", 2.0}};
  EXPECT_EQ(profile_table(status), "phase               seconds    share ns/node-step\n"
                                   "total                2.0000   100.0%            -\n");
}

} // namespace
} // namespace cnem::app
