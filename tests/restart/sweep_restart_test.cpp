// A sweep goes on with the runs that were interrupted from their checkpoints, and ends with the same bits.
#include "results/output_folder.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <thread>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;

class SweepRestart : public ::testing::Test {
protected:
  void SetUp() override {
    std::ofstream(folder / "punched.toml") << small_case("punched");
    write_study("");
  }

  void write_study(const std::string& set) const {
    std::ofstream(folder / "study.toml")
        << "case = \"punched.toml\"\nprocesses = 1\n[[run]]\nname = \"one\"\n"
        << set;
  }
  std::vector<std::string> sweep() const {
    return {"sweep", folder.string(), "--output", (folder / "results").string()};
  }
  fs::path run_folder() const { return folder / "results" / "one"; }
  std::string log() const { return results::read_file(folder / "results" / "one.log"); }
  static bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  void expect_bits_of_an_undisturbed_run() const {
    const Ending ending =
        run_cnem({"run", (folder / "punched.toml").string(), "--output", (folder / "reference").string()});
    ASSERT_EQ(ending.code, 0) << ending.printed;
    EXPECT_EQ(difference(folder / "reference", run_folder()), "");
  }
  /// Waits for the second checkpoint of the run, then sends the signal to the sweep or to the run itself.
  Ending disturbed_sweep(int signal, bool run_itself) const {
    Process process(sweep(), 0, {}, [] { std::signal(SIGHUP, SIG_DFL); }); // also under nohup
    while (process.running() && !fs::exists(run_folder() / "checkpoint.1.h5"))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (run_itself) {
      pid_t child = 0;
      std::ifstream(fmt::format("/proc/{0}/task/{0}/children", process.id())) >> child;
      if (child > 0) ::kill(child, signal);
    } else {
      process.send(signal);
    }
    return process.wait();
  }

  const cnem::testing::TemporaryFolder temporary{"sweep_restart"};
  const fs::path& folder = temporary.path();
};

TEST_F(SweepRestart, a_sweep_that_was_stopped_goes_on_from_the_checkpoints_of_its_runs) {
  Ending stopped = disturbed_sweep(SIGTERM, false);
  ASSERT_EQ(stopped.code, 5) << stopped.printed;
  fs::remove_all(folder / "results");
  stopped = disturbed_sweep(SIGHUP, false);
  ASSERT_EQ(stopped.code, 5) << stopped.printed;
  const Ending again = run_cnem(sweep());
  EXPECT_EQ(again.code, 0) << again.printed;
  EXPECT_TRUE(holds(again.printed, "1 to do in 1 processes, 1 from the last checkpoint")) << again.printed;
  EXPECT_TRUE(holds(log(), "going on from ")) << log();
  expect_bits_of_an_undisturbed_run();
}

TEST_F(SweepRestart, a_run_that_was_killed_goes_on_from_its_checkpoint) {
  const Ending failed = disturbed_sweep(SIGKILL, true);
  ASSERT_EQ(failed.code, 3) << failed.printed;
  EXPECT_TRUE(holds(failed.printed, "killed by signal 9")) << failed.printed;
  const Ending again = run_cnem(sweep());
  EXPECT_EQ(again.code, 0) << again.printed;
  EXPECT_TRUE(holds(log(), "going on from ")) << log();
  expect_bits_of_an_undisturbed_run();
}

TEST_F(SweepRestart, other_inputs_and_force_start_anew) {
  ASSERT_EQ(disturbed_sweep(SIGTERM, false).code, 5);
  std::vector<std::string> forced = sweep();
  forced.emplace_back("--force");
  Ending again = run_cnem(forced);
  EXPECT_EQ(again.code, 0) << again.printed;
  EXPECT_FALSE(holds(log(), "going on from ")) << log();

  fs::remove_all(folder / "results");
  ASSERT_EQ(disturbed_sweep(SIGTERM, false).code, 5);
  write_study("set = { \"time.step.safety\" = 0.5 }\n");
  again = run_cnem(sweep());
  EXPECT_EQ(again.code, 0) << again.printed;
  EXPECT_FALSE(holds(log(), "going on from ")) << log();
}

TEST_F(SweepRestart, a_run_that_diverged_starts_anew) {
  // It would go on to the same end.
  write_study("set = { \"tools.punch.velocity.y.value\" = \"-8000 m/s\" }\n");
  ASSERT_EQ(run_cnem(sweep()).code, 3);
  ASSERT_TRUE(fs::exists(run_folder() / results::files::checkpoint));
  const Ending again = run_cnem(sweep());
  EXPECT_EQ(again.code, 3) << again.printed;
  EXPECT_FALSE(holds(again.printed, "from the last checkpoint")) << again.printed;
}

} // namespace
} // namespace cnem::app
