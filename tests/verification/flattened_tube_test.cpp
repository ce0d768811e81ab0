// A tube that is flattened until its bore lies on itself: passes on a body that touches itself.
#include "tests/finished_run.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

TEST(FlattenedTube, goes_through_all_passes) {
  const FinishedRun done =
      finish(input::read_case(CNEM_SOURCE_DIR "/cases/practice/flattened_tube.toml", {}));
  expect_nothing_lost(done);
  EXPECT_GT(done.metric("adapt.passes"), 15.0);
  EXPECT_EQ(done.metric("adapt.undone"), 0.0);
  EXPECT_LT(done.metric("adapt.crossings"), 40.0);
  EXPECT_LT(std::abs(done.metric("adapt.volume_change")), 5e-5 * 199e-9); // of 199 mm³
}

} // namespace
} // namespace cnem::testing
