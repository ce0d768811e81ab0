// What there is to doubt in milling cases.
#include "app/run.hpp"
#include "input/case_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cnem::app {
namespace {

std::vector<std::string> doubts_of_lobes(std::vector<std::string> set) {
  set.insert(set.end(), {"cutting.flank.land=60 um", "cutting.flank.recovery=1 um",
                         "cutting.flank.specific_force=40 kN/mm^3", "cutting.flank.friction=0.3"});
  return check(input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/wall_lobes/case.toml", set),
               {})
      .warnings;
}

bool tell_of_waves(const std::vector<std::string>& doubts) {
  return std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
    return doubt.find("mode wall of the part leaves waves") != std::string::npos;
  });
}

// A land of 60 um is longer than a radian of the wave of 2000 Hz below 1200 rpm.
TEST(MillingDoubts, FlanksAreComparedWithTheFastestModeAlongThePath) {
  EXPECT_FALSE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1300 rpm"})));
  EXPECT_TRUE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1100 rpm"})));
  // Where it is looked at, it is slower by a fifth.
  EXPECT_FALSE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1100 rpm", "stability.places=100 mm"})));
  EXPECT_TRUE(tell_of_waves(
      doubts_of_lobes({"stability.speed_from=1300 rpm", "modes.wall.frequency_along=1 0.97 1.2 0.84 0.8"})));
}

} // namespace
} // namespace cnem::app
