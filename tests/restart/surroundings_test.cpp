// What the program does when memory, threads, standard output or the terminal go away, when several start at
// once, and when files have strange names.
#include "core/machine/isa.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/restart/process.hpp"
#include "tests/restart/runs.hpp"
#include "tests/temporary_folder.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true; // shadow memory takes more than any limit
#else
constexpr bool sanitized = false;
#endif

class Surroundings : public ::testing::Test {
protected:
  void SetUp() override { std::ofstream(at("punched.toml")) << small_case("punched"); }

  std::string at(const std::string& name) const { return (folder / name).string(); }
  std::vector<std::string> run_of(const std::string& input, const std::string& output,
                                  const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run", at(input), "--output", at(output)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static void wait_for(Process& process, const fs::path& file) {
    while (process.running() && !fs::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void expect_reference(const std::string& output, const std::vector<std::string>& more = {}) const {
    const Ending ending = run_cnem(run_of("punched.toml", "reference", more));
    ASSERT_EQ(ending.code, 0) << ending.printed;
    EXPECT_EQ(difference(folder / "reference", folder / output), "");
  }
  static void expect_part(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in\n" << text;
  }

  const cnem::testing::TemporaryFolder temporary{"surroundings"};
  const fs::path& folder = temporary.path();
};

void limit_address_space(std::size_t bytes) {
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
}

/// Address space of a process, bytes.
std::size_t address_space(pid_t process) {
  std::size_t pages = 0;
  std::ifstream(fmt::format("/proc/{}/statm", process)) >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Blocks that malloc takes from the system and gives back at once: what a run has had before helps it no
// more.
const std::vector<std::string> no_cache{"MALLOC_MMAP_THRESHOLD_=65536", "MALLOC_TRIM_THRESHOLD_=65536",
                                        "MALLOC_ARENA_MAX=1"};

TEST_F(Surroundings, memory_exhausted_amid_a_run_ends_with_4_and_names_the_checkpoint) {
  if (sanitized) GTEST_SKIP();
  const std::vector<std::string> fine{"--set", "cloud.spacing=0.05 mm", "--set", "time.end=1 us", "--threads",
                                      "2"};
  Process process(run_of("punched.toml", "starved", fine), 0, no_cache);
  wait_for(process, folder / "starved" / "checkpoint.h5");
  ASSERT_TRUE(process.running());
  const std::size_t now = address_space(process.id());
  const rlimit limit{now, now};
  ASSERT_EQ(prlimit(process.id(), RLIMIT_AS, &limit, nullptr), 0);
  const Ending ending = process.wait();
  ASSERT_EQ(ending.code, 4) << ending.signal << ending.printed;
  expect_part(ending.printed, "memory is exhausted");
  expect_part(ending.printed, "the last checkpoint is of step");
  expect_part(ending.printed, "cnem restart " + at("starved"));
  const results::RunStatus status = results::read_status(folder / "starved");
  EXPECT_EQ(status.exit, 4);
  expect_part(status.reason, "memory is exhausted");
  const Ending again = run_cnem({"restart", at("starved"), "--threads", "1"});
  EXPECT_EQ(again.code, 0) << again.printed;
  expect_reference("starved", fine);
}

TEST_F(Surroundings, memory_exhausted_wherever_ends_with_4) {
  if (sanitized) GTEST_SKIP();
  const std::vector<std::string> fine{
      "--set", "cloud.spacing=0.05 mm", "--set", "time.max_steps=30", "--threads", "2"};
  int exhausted = 0;
  for (std::size_t megabytes = 60; megabytes < 1000; megabytes += 8) {
    const std::string output = fmt::format("limit{}", megabytes);
    const auto limit = [megabytes] { limit_address_space(megabytes << 20); };
    if (run_cnem({"--version"}, 0, {}, limit).code != 0) continue; // not enough to load the program
    const Ending ending = run_cnem(run_of("punched.toml", output, fine), 0, {}, limit);
    if (ending.code == 0) break;
    EXPECT_EQ(ending.code, 4) << megabytes << " MB, signal " << ending.signal << "\n" << ending.printed;
    if (fs::exists(folder / output / results::files::resolved_case)) {
      ++exhausted;
      EXPECT_EQ(results::read_status(folder / output).exit, 4) << ending.printed;
    }
  }
  EXPECT_GT(exhausted, 2) << "no limit was between the program and its run";
}

TEST_F(Surroundings, a_fault_with_memory_left_ends_as_the_system_says) {
  if (sanitized) GTEST_SKIP();
  Process process(run_of("punched.toml", "fault", {"--set", "time.end=1 us"}));
  wait_for(process, folder / "fault" / "checkpoint.h5");
  ASSERT_TRUE(process.running());
  kill(process.id(), SIGSEGV);
  EXPECT_EQ(process.wait().signal, SIGSEGV);
}

TEST_F(Surroundings, memory_exhausted_in_a_static_analysis_ends_with_4) {
  if (sanitized) GTEST_SKIP();
  const fs::path plate = fs::path(CNEM_SOURCE_DIR) / "cases" / "paper" / "crack_straight";
  const Ending ending = run_cnem(
      {"run", plate.string(), "--output", at("static"), "--threads", "1", "--set", "cloud.spacing=0.01 mm"},
      0, {}, [] { limit_address_space(std::size_t{150} << 20); });
  EXPECT_EQ(ending.code, 4) << ending.signal << ending.printed;
  expect_part(ending.printed, "memory is exhausted");
  EXPECT_EQ(results::read_status(folder / "static").exit, 4);
}

TEST_F(Surroundings, files_that_may_not_grow_end_a_static_analysis_with_4) {
  const fs::path plate = fs::path(CNEM_SOURCE_DIR) / "cases" / "paper" / "crack_straight";
  const Ending ending = run_cnem({"run", plate.string(), "--output", at("static"), "--threads", "1"}, 30000);
  EXPECT_EQ(ending.code, 4) << ending.signal << ending.printed;
  const results::RunStatus status = results::read_status(folder / "static");
  EXPECT_EQ(status.exit, 4);
  expect_part(status.reason, "File too large");
  expect_part(ending.printed, status.reason);
}

TEST_F(Surroundings, threads_that_the_system_does_not_give_end_with_4) {
  if (sanitized) GTEST_SKIP();
  const Ending ending = run_cnem(run_of("punched.toml", "many", {"--threads", "64"}), 0, {}, [] {
    rlimit stack{};
    getrlimit(RLIMIT_STACK, &stack);
    stack.rlim_cur = std::size_t{8} << 20; // of each thread
    setrlimit(RLIMIT_STACK, &stack);
    limit_address_space(std::size_t{400} << 20);
  });
  EXPECT_EQ(ending.code, 4) << ending.printed;
  expect_part(ending.printed, "cannot start 64 threads");
  EXPECT_FALSE(fs::exists(folder / "many"));
}

TEST_F(Surroundings, more_threads_than_are_of_use_are_refused) {
  const Ending run = run_cnem(run_of("punched.toml", "many", {"--threads", "1000000000"}));
  EXPECT_EQ(run.code, 2) << run.printed;
  expect_part(run.printed, "--threads: found 1000000000, expected at most");
  expect_part(run.printed, "this machine has");
  const Ending variable = run_cnem(run_of("punched.toml", "many"), 0, {"OMP_NUM_THREADS=100000"});
  EXPECT_EQ(variable.code, 2) << variable.printed;
  expect_part(variable.printed, "OMP_NUM_THREADS: found 100000");
  EXPECT_FALSE(fs::exists(folder / "many"));
}

TEST_F(Surroundings, a_reader_that_goes_away_ends_nothing) {
  for (const bool errors_too : {false, true}) {
    const std::string output = errors_too ? "deaf" : "piped";
    const Ending ending = run_cnem(run_of("punched.toml", output), 0, {}, [errors_too] {
      std::signal(SIGPIPE, SIG_DFL);
      std::array<int, 2> end{};
      if (pipe(end.data()) != 0) _exit(126);
      close(end[0]);
      dup2(end[1], STDOUT_FILENO);
      if (errors_too) dup2(end[1], STDERR_FILENO);
    });
    EXPECT_EQ(ending.code, 0) << ending.signal << ending.printed;
    EXPECT_EQ(results::read_status(folder / output).exit, 0);
  }
}

TEST_F(Surroundings, standard_output_that_cannot_be_written_ends_with_4) {
  const auto on_full_disk = [](const std::vector<std::string>& words) {
    return run_cnem(words, 0, {}, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  };
  const std::string output = at("full");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"schema"},
                                                {"schema", "--markdown"},
                                                {"--help"},
                                                {"--version"},
                                                {"check", at("punched.toml"), "--output", output},
                                                run_of("punched.toml", "full"),
                                                {"report", output},
                                                {"restart", output}}) {
    const Ending ending = on_full_disk(words);
    EXPECT_EQ(ending.code, 4) << words.front() << ending.signal << ending.printed;
    expect_part(ending.printed, "cannot write to standard output: No space left on device");
  }
  EXPECT_EQ(results::read_status(output).exit, 0) << "the run itself went well";
  // Wrong input stays what it is.
  EXPECT_EQ(on_full_disk({"check", at("absent.toml")}).code, 2);
}

TEST_F(Surroundings, a_closed_standard_output_is_no_file_of_results) {
  const Ending ending = run_cnem(run_of("punched.toml", "closed"), 0, {}, [] { close(STDOUT_FILENO); });
  EXPECT_EQ(ending.code, 4) << ending.printed;
  expect_reference("closed");
}

TEST_F(Surroundings, a_hang_up_stops_at_a_checkpoint_unless_it_was_ignored) {
  for (const bool ignored : {false, true}) {
    const std::string output = ignored ? "nohup" : "hung_up";
    Process process(run_of("punched.toml", output), 0, {},
                    [ignored] { std::signal(SIGHUP, ignored ? SIG_IGN : SIG_DFL); });
    wait_for(process, folder / output / results::files::checkpoint);
    process.send(SIGHUP);
    const Ending ending = process.wait();
    EXPECT_EQ(ending.code, ignored ? 0 : 5) << ending.signal << ending.printed;
    if (ignored) continue;
    expect_part(results::read_status(folder / output).reason, "by SIGHUP");
    EXPECT_EQ(run_cnem({"restart", at(output)}).code, 0);
    expect_reference(output);
  }
}

TEST_F(Surroundings, names_of_files_may_hold_any_character) {
  for (const char* name : {"a\nb.toml", "a\x01\x7f\tb.toml", "latin\xe9.toml", "utf-8 é.toml"}) {
    fs::copy(at("punched.toml"), at(name));
    const std::string output = std::string("of ") + name;
    const Ending ending = run_cnem(run_of(name, output, {"--set", "time.max_steps=30"}));
    EXPECT_EQ(ending.code, 0) << ending.printed;
    EXPECT_TRUE(fs::exists(folder / output / results::files::report));
    fs::remove(folder / output / results::files::status);
    const Ending again = run_cnem({"restart", at(output)});
    EXPECT_EQ(again.code, 0) << again.printed;
    expect_part(again.printed, "going on from");
  }
}

TEST_F(Surroundings, of_several_starts_into_a_new_folder_one_runs) {
  std::vector<std::unique_ptr<Process>> processes;
  for (int k = 0; k < 6; ++k)
    processes.push_back(std::make_unique<Process>(run_of("punched.toml", "new", {"--threads", "1"})));
  int done = 0;
  for (const auto& process : processes) {
    const Ending ending = process->wait();
    done += ending.code == 0;
    if (ending.code == 0) continue;
    EXPECT_EQ(ending.code, 2) << ending.printed;
    // Who comes when the first one is done finds its run.
    if (ending.printed.find("already holds a run") == std::string::npos)
      expect_part(ending.printed, "another run is using the folder " + at("new"));
  }
  EXPECT_EQ(done, 1);
  expect_reference("new");
}

TEST_F(Surroundings, a_restart_with_another_instruction_set_says_so) {
  if (active_isa() == Isa::baseline) GTEST_SKIP() << "this machine has one set";
  const std::vector<std::string> short_run{"--set", "time.max_steps=30"};
  ASSERT_EQ(run_cnem(run_of("punched.toml", "run", short_run), 0, {"CNEM_ISA=baseline"}).code, 0);
  const auto restarted = [&](const std::vector<std::string>& environment) {
    fs::remove(folder / "run" / results::files::status);
    const Ending ending = run_cnem({"restart", at("run")}, 0, environment);
    EXPECT_EQ(ending.code, 0) << ending.printed;
    return ending.printed;
  };
  EXPECT_EQ(restarted({}).find("instruction set"), std::string::npos) << "that of the checkpoint is taken";
  EXPECT_TRUE(results::read_status(folder / "run").warnings.empty());
  const std::string other(isa_name(active_isa()));
  const std::string warning = "the run began with instruction set baseline and goes on with " + other;
  expect_part(restarted({"CNEM_ISA=" + other}), "warning: " + warning);
  const std::vector<std::string> warnings = results::read_status(folder / "run").warnings;
  ASSERT_EQ(warnings.size(), 1U);
  expect_part(warnings.front(), warning);
}

TEST_F(Surroundings, what_left_its_measured_range_is_told_once_and_the_same_after_a_restart) {
  // Strains leave their range early, temperatures after the checkpoint that is gone back to, rates never.
  const std::vector<std::string> ranges{"--set",
                                        "materials.steel.plastic.range={ strain = [0.0, 0.005], rate = \"0 "
                                        "1e9 /s\", temperature = \"280 304 K\" }",
                                        "--set",
                                        "time.max_steps=140",
                                        "--set",
                                        "output.checkpoint.every_steps=60"};
  const Ending whole = run_cnem(run_of("punched.toml", "run", ranges));
  ASSERT_EQ(whole.code, 0) << whole.printed;
  const std::vector<std::string> warnings = results::read_status(folder / "run").warnings;
  ASSERT_EQ(warnings.size(), 2U) << whole.printed;
  expect_part(warnings[0], "plastic strain at node");
  expect_part(warnings[0], "outside the range 0 to 0.005 in which the constants of steel were measured");
  expect_part(warnings[1], "temperature at node");
  for (const std::string& warning : warnings) {
    const std::size_t told = whole.printed.find("warning: " + warning);
    ASSERT_NE(told, std::string::npos) << whole.printed;
    EXPECT_EQ(whole.printed.find(warning, told + warning.size()), std::string::npos) << whole.printed;
  }
  // From the older checkpoint: what came after it is found again, at the same step.
  fs::remove(folder / "run" / results::files::status);
  fs::rename(folder / "run" / "checkpoint.1.h5", folder / "run" / "checkpoint.h5");
  const Ending again = run_cnem({"restart", at("run"), "--threads", "2"});
  ASSERT_EQ(again.code, 0) << again.printed;
  EXPECT_EQ(results::read_status(folder / "run").warnings, warnings);
}

TEST_F(Surroundings, an_instruction_set_that_does_not_exist_is_refused) {
  for (const auto& words : {run_of("punched.toml", "none"),
                            std::vector<std::string>{"check", at("punched.toml")},
                            {"restart", at("none")},
                            {"sweep", folder.string()}}) {
    const Ending ending = run_cnem(words, 0, {"CNEM_ISA=sse9"});
    EXPECT_EQ(ending.code, 2) << ending.printed;
    expect_part(ending.printed,
                "CNEM_ISA = \"sse9\": expected an instruction set that this machine has: baseline");
  }
  EXPECT_FALSE(fs::exists(folder / "none"));
}

} // namespace
} // namespace cnem::app
