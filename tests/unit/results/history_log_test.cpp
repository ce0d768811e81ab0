// Rows of a history in a file, in memory, or in both.
#include "results/history_log.hpp"

#include "core/error.hpp"
#include "tests/temporary_folder.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace cnem::results {
namespace {

const std::vector<std::string> names{"time[s]", "force[N]"};

void fill(HistoryLog& log, int rows, int from = 0) {
  for (int k = from; k < rows; ++k) log.write(std::vector<double>{0.1 * k, 1.0 / (k + 1)});
}

TEST(HistoryLog, without_a_file_rows_are_in_memory_and_can_be_dropped) {
  HistoryLog log;
  EXPECT_FALSE(log.begun());
  log.start({}, names);
  fill(log, 5);
  EXPECT_EQ(log.table().rows(), 5U);
  EXPECT_EQ(log.columns()[1][4], 0.2);
  const KeptField kept(log.columns()[1]);
  log.resume({}, names, 3);
  log.write(std::vector<double>{0.3, 7.0});
  EXPECT_EQ(log.columns()[1][3], 7.0);
  EXPECT_EQ(kept.data()[3], 0.25) << "whoever looks at them keeps them";
  EXPECT_FALSE(kept.is_of(log.columns()[1]));
  EXPECT_EQ(log.table().rows(), 4U);
  EXPECT_EQ(log.table().names, names);
}

TEST(HistoryLog, a_file_has_the_same_rows_as_memory_beside_it) {
  const cnem::testing::TemporaryFolder folder("history_log");
  const std::filesystem::path path = folder.path() / "history.csv";
  HistoryLog both(true), file;
  both.start(path, names);
  fill(both, 7);
  EXPECT_EQ(both.table().column, read_history(path).column);
  HistoryLog again(true);
  again.resume(path, names, 6);
  EXPECT_EQ(again.columns()[0].size(), 6U);
  EXPECT_EQ(again.columns()[1][5], 1.0 / 6.0);
  file.resume(path, names, 6);
  fill(file, 7, 6);
  EXPECT_TRUE(file.columns().empty());
  EXPECT_EQ(file.table().column, both.table().column);
  EXPECT_THROW(again.resume(path, names, 9), IoError);
}

} // namespace
} // namespace cnem::results
