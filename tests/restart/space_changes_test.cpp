// What the cases in space that others are killed on go through: one is refined, one parts, two are periodic.
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

struct Finished {
  Ending ending;
  std::map<std::string, double> metric;
};

Finished finished(const std::string& name) {
  const cnem::testing::TemporaryFolder temporary(name);
  const auto input = temporary.path() / "case.toml", output = temporary.path() / "run";
  std::ofstream(input) << small_case(name);
  const Ending ending = run_cnem({"run", input.string(), "--output", output.string(), "--threads", "1"});
  EXPECT_EQ(ending.code, 0) << ending.printed;
  if (ending.code != 0) return {ending, {}};
  const results::RunStatus status = results::read_status(output);
  return {ending, {status.metrics.begin(), status.metrics.end()}};
}

TEST(SpaceRefined, halves_cells_at_the_foot) {
  const auto metric = finished("space_refined").metric;
  EXPECT_GT(metric.at("adapt.refined"), 20.0);
  EXPECT_GT(metric.at("adapt.inserted") + metric.at("adapt.inserted_boundary"), 50.0);
  EXPECT_EQ(metric.at("adapt.not_estimated"), 0.0);
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
}

TEST(SpaceEdge, nodes_come_where_the_tool_is_before_the_first_step_and_after) {
  const auto metric = finished("space_edge").metric;
  EXPECT_GT(metric.at("adapt.inserted_boundary"), 25.0);
  EXPECT_GT(metric.at("adapt.inserted"), 5.0);
  EXPECT_EQ(metric.at("adapt.undone"), 0.0);
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
}

TEST(SpaceSheared, parts_once_and_every_pass_succeeds) {
  const auto [ending, metric] = finished("space_sheared");
  EXPECT_EQ(metric.at("adapt.cuts"), 1.0);
  EXPECT_GT(metric.at("adapt.opened"), 5.0);
  EXPECT_EQ(metric.at("adapt.crossings"), 0.0);
  EXPECT_EQ(metric.at("retries"), 0.0);
  EXPECT_EQ(ending.printed.find("could not be renewed"), std::string::npos) << ending.printed;
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
  EXPECT_LT(std::abs(metric.at("adapt.momentum_error")), 1e-12);
}

TEST(SpacePeriodic, nodes_come_and_go_on_both_sides) {
  const auto [ending, metric] = finished("space_periodic");
  EXPECT_GT(metric.at("adapt.inserted_boundary"), 5.0);
  EXPECT_EQ(metric.at("adapt.crossings"), 0.0);
  EXPECT_EQ(metric.at("retries"), 0.0);
  EXPECT_EQ(ending.printed.find("could not be renewed"), std::string::npos) << ending.printed;
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
  EXPECT_LT(std::abs(metric.at("adapt.momentum_error")), 1e-12);
}

TEST(SpaceImages, passes_between_lips_that_meet_images_keep_what_they_carry) {
  const auto [ending, metric] = finished("space_images");
  EXPECT_GT(metric.at("adapt.inserted_boundary"), 5.0);
  EXPECT_EQ(metric.at("retries"), 0.0);
  EXPECT_LT(std::abs(metric.at("adapt.mass_error")), 1e-12);
  EXPECT_LT(std::abs(metric.at("adapt.momentum_error")), 1e-12);
}

} // namespace
} // namespace cnem::app
