// The strip in space that others are killed on parts once, and no pass over it fails.
#include "results/status.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <map>

namespace cnem::app {
namespace {

TEST(SpaceSheared, parts_once_and_every_pass_succeeds) {
  const cnem::testing::TemporaryFolder temporary("parting");
  const auto input = temporary.path() / "strip.toml", output = temporary.path() / "run";
  std::ofstream(input) << small_case("space_sheared");
  const Ending ending = run_cnem({"run", input.string(), "--output", output.string(), "--threads", "1"});
  ASSERT_EQ(ending.code, 0) << ending.printed;
  const results::RunStatus status = results::read_status(output);
  std::map<std::string, double> metric(status.metrics.begin(), status.metrics.end());
  EXPECT_EQ(metric.at("adapt.cuts"), 1.0);
  EXPECT_GT(metric.at("adapt.opened"), 5.0);
  EXPECT_EQ(metric.at("adapt.crossings"), 0.0);
  EXPECT_EQ(metric.at("retries"), 0.0);
  EXPECT_EQ(ending.printed.find("could not be renewed"), std::string::npos) << ending.printed;
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
  EXPECT_LT(std::abs(metric.at("adapt.momentum_error")), 1e-12);
}

} // namespace
} // namespace cnem::app
