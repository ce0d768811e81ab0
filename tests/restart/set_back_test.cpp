// A run that goes back after a failure: what it leaves is that of one course, counted, and given up in the
// end.
#include "results/checkpoint_folder.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;

class SetBack : public ::testing::Test {
protected:
  void SetUp() override { std::ofstream(folder / "set_back.toml") << small_case("set_back"); }
  Ending run(const std::string& output, std::vector<std::string> more) const {
    std::vector<std::string> words{"run", (folder / "set_back.toml").string(), "--output",
                                   (folder / output).string()};
    words.insert(words.end(), more.begin(), more.end());
    return run_cnem(words);
  }
  static double retries(const results::RunStatus& status) {
    for (const auto& [name, value] : status.metrics)
      if (name == "retries") return value;
    return -1.0;
  }

  const cnem::testing::TemporaryFolder temporary{"set_back"};
  const fs::path& folder = temporary.path();
};

TEST_F(SetBack, a_run_that_gets_past_a_failure_is_counted_and_leaves_one_course) {
  const Ending ending = run("run", {"--threads", "1"});
  ASSERT_EQ(ending.code, 0) << ending.printed;
  EXPECT_NE(ending.printed.find("back to step"), std::string::npos) << ending.printed;
  const results::RunStatus status = results::read_status(folder / "run");
  EXPECT_EQ(retries(status), 2.0);
  EXPECT_EQ(status.warnings.size(), 1U);
  for (const char* file : {results::files::history, results::files::adaptation}) {
    const std::vector<double> time = results::read_history(folder / "run" / file).column[0];
    EXPECT_EQ(std::adjacent_find(time.begin(), time.end(), std::greater_equal<>()), time.end()) << file;
    EXPECT_GT(time.size(), 2U) << file;
  }
  std::size_t frames = 0;
  const std::string series = results::read_file(folder / "run" / results::files::fields);
  for (std::size_t at = 0; (at = series.find("part=\"0\"", at)) != std::string::npos; ++at) ++frames;
  EXPECT_EQ(frames, 31U);
}

TEST_F(SetBack, it_ends_with_the_same_bits_from_every_checkpoint_before_and_after_a_failure) {
  const std::vector<std::string> often{
      "--threads", "1", "--set", "output.checkpoint.every_steps=30", "--set", "output.checkpoint.keep=1000"};
  ASSERT_EQ(run("run", often).code, 0);
  const std::size_t kept = results::list_checkpoints(folder / "run").size();
  ASSERT_GT(kept, 5U);
  int again = 0;
  for (std::size_t k = 0; k < kept; k += kept / 5) {
    const fs::path copy = folder / std::to_string(k);
    fs::copy(folder / "run", copy, fs::copy_options::recursive);
    const std::vector<fs::path> checkpoints = results::list_checkpoints(copy); // the newest first
    for (std::size_t newer = 0; newer < k; ++newer) fs::remove(checkpoints[newer]);
    fs::remove(copy / results::files::status);
    const Ending ending = run_cnem({"restart", copy.string(), "--threads", "2"});
    EXPECT_EQ(ending.code, 0) << ending.printed;
    EXPECT_EQ(difference(folder / "run", copy), "") << "from " << checkpoints[k];
    again += ending.printed.find("back to step") != std::string::npos;
  }
  EXPECT_GT(again, 0) << "no checkpoint was from before the failure";
}

TEST_F(SetBack, a_failure_that_always_returns_ends_the_run_with_3) {
  const Ending ending = run("run", {"--threads", "1", "--set", "time.step.min=21.4 ns"});
  EXPECT_EQ(ending.code, 3) << ending.printed;
  const results::RunStatus status = results::read_status(folder / "run");
  EXPECT_EQ(retries(status), 3.0);
  ASSERT_TRUE(status.post_mortem);
  EXPECT_NE(status.post_mortem->text.find("stable step"), std::string::npos) << status.post_mortem->text;
}

TEST_F(SetBack, without_a_strain_that_renews_the_reference_the_first_failure_is_final) {
  const Ending ending = run("run", {"--threads", "1", "--set", "time.step.min=22.5 ns", "--set",
                                    "method.rereference.strain=0", "--set", "method.rereference.every=60"});
  EXPECT_EQ(ending.code, 3) << ending.printed;
  EXPECT_EQ(retries(results::read_status(folder / "run")), 0.0);
}

} // namespace
} // namespace cnem::app
