// A run that was killed, stopped or denied disk space, and went on, ends with the bits of one that was not.
#include "results/checkpoint.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/mount.h>
#include <thread>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

class Restart : public ::testing::Test {
protected:
  void SetUp() override {
    for (const SmallCase& small : small_cases())
      std::ofstream(folder / (std::string(small.name) + ".toml")) << small.text;
  }

  std::string at(const std::string& name) const { return (folder / name).string(); }
  std::vector<std::string> run_of(const std::string& name, const std::string& output,
                                  std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"run", at(name + ".toml"), "--output", at(output)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// A finished run to compare with.
  void reference(const std::string& name, std::vector<std::string> more = {"--threads", "1"}) {
    const Ending ending = run_cnem(run_of(name, "reference", std::move(more)));
    ASSERT_EQ(ending.code, 0) << ending.printed;
  }
  Ending restart(const std::string& output) const {
    return run_cnem({"restart", at(output), "--threads", "2"});
  }
  void expect_reference(const std::string& output) const {
    EXPECT_EQ(difference(folder / "reference", folder / output), "");
  }
  /// Waits until the process has ended or its folder holds a file.
  static void wait_for(Process& process, const fs::path& file) {
    while (process.running() && !fs::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// A run stopped by SIGTERM once it has written as many checkpoints as it keeps; it keeps three.
  void stopped_run(const std::string& output) {
    Process process(run_of("punched", output, {"--threads", "1"}));
    wait_for(process, folder / output / "checkpoint.2.h5");
    process.send(SIGTERM);
    const Ending ending = process.wait();
    ASSERT_EQ(ending.code, 5) << ending.printed;
  }

  const cnem::testing::TemporaryFolder temporary{"restart"};
  const fs::path& folder = temporary.path();
};

/// Kills a run and its restarts at random moments: the first one in its set-up, the others later; `whole` is
/// how long an undisturbed run takes, s.
void kill_until_done(const std::string& name, const fs::path& folder, const std::vector<std::string>& run,
                     double whole, unsigned seed, int kills) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> early(0.0, 0.1), late(0.0, 0.4 * whole);
  int killed = 0;
  std::vector<std::string> command = run;
  for (int k = 0; k < kills; ++k) {
    Process process(command);
    while (k > 0 && process.running() && !fs::exists(folder / results::files::checkpoint))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(Seconds(k == 0 ? early(random) : late(random)));
    process.send(SIGKILL);
    killed += process.wait().signal == SIGKILL;
    if (fs::exists(folder / results::files::resolved_case))
      command = {"restart", folder.string(), "--threads", "3"};
  }
  EXPECT_GT(killed, 0) << name << ": the kills came too late";
  const Ending ending = run_cnem(command);
  ASSERT_EQ(ending.code, 0) << ending.printed;
}

class KilledRun : public Restart, public ::testing::WithParamInterface<int> {};

TEST_P(KilledRun, ends_with_the_same_bits) {
  const SmallCase& small = small_cases()[static_cast<std::size_t>(GetParam())];
  const auto begin = std::chrono::steady_clock::now();
  reference(small.name);
  const double whole = Seconds(std::chrono::steady_clock::now() - begin).count();
  const char* repeat = std::getenv("CNEM_KILL_ROUNDS");
  for (int round = 0; round < (repeat ? std::atoi(repeat) : 1); ++round) {
    const std::string output = "killed" + std::to_string(round);
    kill_until_done(small.name, folder / output, run_of(small.name, output, {"--threads", "2"}), whole,
                    static_cast<unsigned>(17 * round + GetParam()), 4);
    expect_reference(output);
  }
}
INSTANTIATE_TEST_SUITE_P(, KilledRun, ::testing::Range(0, static_cast<int>(small_cases().size())),
                         [](const auto& parameter) {
                           return std::string(small_cases()[static_cast<std::size_t>(parameter.param)].name);
                         });

TEST_F(Restart, sigterm_stops_at_a_checkpoint_with_5_and_goes_on) {
  reference("punched");
  for (const int signal : {SIGTERM, SIGINT}) {
    const std::string output = "stopped" + std::to_string(signal);
    Process process(run_of("punched", output, {"--set", "output.checkpoint.every_steps=0"}));
    wait_for(process, folder / output / "checkpoint.h5");
    process.send(signal);
    const Ending ending = process.wait();
    ASSERT_EQ(ending.code, 5) << ending.printed;
    EXPECT_NE(ending.printed.find("cnem restart"), std::string::npos) << ending.printed;
    const results::RunStatus status = results::read_status(folder / output);
    EXPECT_EQ(status.exit, 5);
    EXPECT_LT(status.time, 12e-6);
    EXPECT_EQ(restart(output).code, 0);
    expect_reference(output);
  }
}

TEST_F(Restart, sigterm_in_the_set_up_stops_at_step_0) {
  reference("punched");
  Process process(run_of("punched", "early"));
  wait_for(process, folder / "early" / "case.resolved.toml");
  process.send(SIGTERM);
  const Ending ending = process.wait();
  EXPECT_EQ(ending.code, 5) << ending.printed;
  EXPECT_EQ(restart("early").code, 0);
  expect_reference("early");
}

TEST_F(Restart, sigusr1_writes_a_checkpoint_and_goes_on) {
  reference("punched");
  Process process(run_of("punched", "asked", {"--set", "output.checkpoint.every_steps=0"}));
  wait_for(process, folder / "asked" / "checkpoint.h5");
  EXPECT_FALSE(fs::exists(folder / "asked" / "checkpoint.1.h5"));
  process.send(SIGUSR1);
  const Ending ending = process.wait();
  EXPECT_EQ(ending.code, 0) << ending.printed;
  EXPECT_TRUE(fs::exists(folder / "asked" / "checkpoint.1.h5"));
  expect_reference("asked");
}

TEST_F(Restart, a_bad_checkpoint_is_refused_with_the_reason_and_the_one_before_it_used) {
  reference("punched");
  ASSERT_EQ(run_cnem(run_of("punched", "other",
                            {"--set", "initial.temperature=310 K", "--set", "time.max_steps=3"}))
                .code,
            0);
  stopped_run("stopped");
  const std::string newest = results::read_file(folder / "stopped" / "checkpoint.h5");
  std::string flipped = newest, format = newest;
  flipped[newest.size() / 2] = static_cast<char>(flipped[newest.size() / 2] ^ 4);
  const std::string own = "format " + std::to_string(results::checkpoint_format);
  const std::string other = "format " + std::to_string(results::checkpoint_format + 1);
  format.replace(format.find(own), own.size(), other);
  for (const auto& [name, content, reason] :
       {std::tuple("truncated", newest.substr(0, newest.size() / 2), "cut short"),
        std::tuple("empty", std::string(), "empty"), std::tuple("flipped", flipped, "checksum"),
        std::tuple("foreign", newest.substr(512), "HDF5 file, but no checkpoint of cnem"),
        std::tuple("format", format, other.c_str()),
        std::tuple("case", results::read_file(folder / "other" / "checkpoint.h5"),
                   "belongs to another case")}) {
    fs::copy(folder / "stopped", folder / name, fs::copy_options::recursive);
    std::ofstream(folder / name / "checkpoint.h5", std::ios::binary) << content;
    const Ending ending = restart(name);
    EXPECT_EQ(ending.code, 0) << name << ":\n" << ending.printed;
    EXPECT_NE(ending.printed.find(reason), std::string::npos) << name << ":\n" << ending.printed;
    EXPECT_NE(ending.printed.find("checkpoint.1.h5"), std::string::npos) << name << ":\n" << ending.printed;
    expect_reference(name);
    EXPECT_EQ(results::read_status(folder / name).warnings.size(), 1U) << name;
    EXPECT_TRUE(fs::exists(folder / name / "checkpoint.refused.h5")) << name;
  }
}

TEST_F(Restart, without_a_good_checkpoint_it_starts_at_step_0) {
  reference("punched");
  stopped_run("stopped");
  fs::copy(folder / "stopped", folder / "none", fs::copy_options::recursive);
  for (const fs::path& path : results::list_checkpoints(folder / "none")) fs::remove(path);
  for (const fs::path& path : results::list_checkpoints(folder / "stopped")) fs::resize_file(path, 1000);
  for (const char* name : {"none", "stopped"}) {
    const Ending ending = restart(name);
    EXPECT_EQ(ending.code, 0) << ending.printed;
    EXPECT_NE(ending.printed.find("starting at step 0"), std::string::npos) << ending.printed;
    expect_reference(name);
  }
  EXPECT_TRUE(results::read_status(folder / "none").warnings.empty()) << "as after a kill in the set-up";
  // What was refused is told and kept, until the run is replaced.
  const std::vector<std::string> warnings = results::read_status(folder / "stopped").warnings;
  ASSERT_EQ(warnings.size(), 4U);
  EXPECT_NE(warnings[0].find("checkpoint.h5 is refused: it is cut short"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[3].find("no good checkpoint"), std::string::npos) << warnings[3];
  for (const char* name : {"checkpoint.refused.h5", "checkpoint.refused.1.h5", "checkpoint.refused.2.h5"})
    EXPECT_TRUE(fs::exists(folder / "stopped" / name)) << name;
  EXPECT_EQ(run_cnem(run_of("punched", "stopped", {"--force"})).code, 0);
  EXPECT_FALSE(fs::exists(folder / "stopped" / "checkpoint.refused.h5"));
}

TEST_F(Restart, results_that_were_lost_after_all_make_an_older_checkpoint_count) {
  reference("punched");
  stopped_run("stopped");
  // As after a power failure on a disk that does not keep its promises.
  const results::CheckpointInfo newest = [&] {
    results::CheckpointReader reader(results::read_file(folder / "stopped" / "checkpoint.1.h5"));
    results::CheckpointInfo info;
    info.archive(reader);
    return info;
  }();
  const fs::path history = folder / "stopped" / "history.csv";
  const std::vector<double> time = results::read_history(history).column[0];
  results::truncate_history(
      history, std::count_if(time.begin(), time.end(), [&](double t) { return t <= newest.time; }));
  const Ending ending = restart("stopped");
  EXPECT_EQ(ending.code, 0) << ending.printed;
  expect_reference("stopped");
}

TEST_F(Restart, an_edited_case_is_not_gone_on_with) {
  stopped_run("stopped");
  std::string text = results::read_file(folder / "stopped" / "case.resolved.toml");
  text.replace(text.find("coefficient = 0.2"), 17, "coefficient = 0.3");
  std::ofstream(folder / "stopped" / "case.resolved.toml") << text;
  const Ending ending = restart("stopped");
  EXPECT_EQ(ending.code, 2) << ending.printed;
  EXPECT_NE(ending.printed.find("case.resolved.toml"), std::string::npos) << ending.printed;
  EXPECT_TRUE(fs::exists(folder / "stopped" / "checkpoint.h5"));
}

TEST_F(Restart, a_damaged_status_does_not_keep_it_from_good_checkpoints) {
  stopped_run("stopped");
  std::ofstream(folder / "stopped" / "status.json") << "{ \"exit\": 5, ";
  const Ending ending = restart("stopped");
  EXPECT_EQ(ending.code, 0) << ending.printed;
  EXPECT_NE(ending.printed.find("going on from"), std::string::npos) << ending.printed;
}

TEST_F(Restart, says_so_where_there_is_nothing_to_go_on_with) {
  reference("triangles");
  const Ending finished = restart("reference");
  EXPECT_EQ(finished.code, 0);
  EXPECT_NE(finished.printed.find("finished"), std::string::npos) << finished.printed;
  fs::create_directories(folder / "nothing");
  for (const char* name : {"nothing", "absent"}) {
    const Ending ending = restart(name);
    EXPECT_EQ(ending.code, 2) << ending.printed;
    EXPECT_NE(ending.printed.find("no run"), std::string::npos) << ending.printed;
  }
}

TEST_F(Restart, a_static_analysis_is_solved_again) {
  const fs::path plate = fs::path(CNEM_SOURCE_DIR) / "cases" / "paper" / "crack_straight";
  ASSERT_EQ(run_cnem({"run", plate.string(), "--output", at("reference")}).code, 0);
  fs::copy(folder / "reference", folder / "static", fs::copy_options::recursive);
  fs::remove(folder / "static" / "status.json");
  const Ending ending = restart("static");
  EXPECT_EQ(ending.code, 0) << ending.printed;
  EXPECT_NE(ending.printed.find("no checkpoints"), std::string::npos) << ending.printed;
  EXPECT_EQ(results::read_file(folder / "static" / "history.csv"),
            results::read_file(folder / "reference" / "history.csv"));
}

TEST_F(Restart, a_folder_at_work_is_left_alone) {
  Process process(run_of("punched", "busy"));
  wait_for(process, folder / "busy" / "checkpoint.h5");
  const Ending ending = restart("busy");
  EXPECT_EQ(ending.code, 2) << ending.printed;
  EXPECT_NE(ending.printed.find("another run is using the folder"), std::string::npos) << ending.printed;
}

TEST_F(Restart, wrong_geometry_leaves_no_folder) {
  EXPECT_EQ(run_cnem(run_of("punched", "wrong", {"--set", "cloud.spacing=1e-8 m"})).code, 2);
  EXPECT_FALSE(fs::exists(folder / "wrong"));
}

TEST_F(Restart, a_file_that_may_not_grow_stops_the_run_with_4_and_a_valid_checkpoint) {
  // Its history is the file that grows most, once checkpoints hold no state to go back to.
  const std::vector<std::string> alone{"--threads", "1", "--set", "method.rereference.strain=0"};
  reference("loaded", alone);
  const std::size_t limit = fs::file_size(folder / "reference" / "history.csv") / 2;
  ASSERT_LT(fs::file_size(folder / "reference" / "checkpoint.h5"), limit);
  const Ending ending = run_cnem(run_of("loaded", "limited", alone), limit);
  EXPECT_EQ(ending.code, 4) << ending.printed;
  EXPECT_NE(ending.printed.find("history.csv"), std::string::npos) << ending.printed;
  EXPECT_EQ(results::read_status(folder / "limited").exit, 4);
  EXPECT_NO_THROW(results::CheckpointReader(results::read_file(folder / "limited" / "checkpoint.h5")));
  EXPECT_EQ(restart("limited").code, 0);
  expect_reference("limited");
}

TEST_F(Restart, a_folder_of_frames_that_goes_away_stops_the_run_with_4_and_a_valid_checkpoint) {
  Process process(run_of("punched", "robbed", {"--threads", "1"}));
  wait_for(process, folder / "robbed" / "checkpoint.h5");
  ASSERT_TRUE(process.running());
  fs::remove_all(folder / "robbed" / "fields");
  const Ending ending = process.wait();
  EXPECT_EQ(ending.code, 4) << ending.printed;
  EXPECT_NE(ending.printed.find("fields/cells_0000"), std::string::npos) << ending.printed;
  EXPECT_EQ(results::read_status(folder / "robbed").exit, 4);
  EXPECT_NO_THROW(results::CheckpointReader(results::read_file(folder / "robbed" / "checkpoint.h5")));
  fs::create_directories(folder / "robbed" / "fields");
  EXPECT_EQ(restart("robbed").code, 0);
}

TEST_F(Restart, a_full_disk_stops_the_run_with_4_and_a_valid_checkpoint) {
  reference("loaded");
  fs::create_directories(folder / "disk");
  const std::uintmax_t room = 3 * fs::file_size(folder / "reference" / "checkpoint.h5") +
                              fs::file_size(folder / "reference" / "history.csv") / 2;
  const std::string options = "size=" + std::to_string(room);
  if (mount("tmpfs", at("disk").c_str(), "tmpfs", 0, options.c_str()) != 0)
    GTEST_SKIP() << "mounting a small disk needs privileges";
  const Ending ending = run_cnem(run_of("loaded", "disk/run"));
  const Ending again = restart("disk/run");
  fs::copy(folder / "disk" / "run", folder / "saved", fs::copy_options::recursive);
  umount(at("disk").c_str());
  EXPECT_EQ(ending.code, 4) << ending.printed;
  EXPECT_NE(ending.printed.find("No space left"), std::string::npos) << ending.printed;
  EXPECT_EQ(again.code, 4) << again.printed;
  EXPECT_NO_THROW(results::CheckpointReader(results::read_file(folder / "saved" / "checkpoint.h5")));
  EXPECT_EQ(restart("saved").code, 0);
  expect_reference("saved");
}

} // namespace
} // namespace cnem::app
