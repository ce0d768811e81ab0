// A parameter study as a user calls it: the list of runs, its refusals, going on after a stop, failures.
#include "study/sweep.hpp"

#include "core/error.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "study/process_pool.hpp"
#include "tests/temporary_folder.hpp"

#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* plate = R"toml(
[analysis]
type = "static"
kinematics = "plane stress"
[domain]
material = "plate"
outer.rectangle = { from = "0 0 mm", to = "2 1 mm" }
[cloud]
spacing = "0.25 mm"
[materials.plate]
density = "1000 kg/m3"
elastic = { young = "1 MPa", poisson = 0.3 }
[boundary]
right = { pieces = ["right"], traction = "1 0 kPa" }
left = { pieces = ["left"], displacement.x = "0 m" }
corner = { points = ["0 0 mm"], displacement = "0 0 m" }
)toml";

class Sweep : public ::testing::Test {
protected:
  void SetUp() override {
    fs::create_directories(folder / "plate");
    std::ofstream(folder / "plate" / "case.toml") << plate;
  }

  Study study(const std::string& text) {
    return read_study_text("case = \"plate\"\n" + text, folder / "loads.toml");
  }
  /// Message with which a study, whose first line is the case, is refused by reader or sweep.
  std::string refusal(const std::string& text) {
    try {
      run(study(text));
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  int run(const Study& input, bool force = false) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::exception_ptr problem;
    int code = -1;
    try {
      code = sweep(input, {.output = out(), .force = force, .program = CNEM_PROGRAM, .version = "test"});
    } catch (...) { problem = std::current_exception(); }
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    if (problem) std::rethrow_exception(problem);
    return code;
  }
  fs::path out() const { return folder / "results"; }
  void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << "\nin " << text;
  }

  const cnem::testing::TemporaryFolder temporary{"sweep"};
  const fs::path& folder = temporary.path();
  std::string printed, message;
};

TEST_F(Sweep, a_grid_is_a_product_whose_first_key_is_the_slowest) {
  const Study s =
      study("[set]\n\"time.end\" = \"2 s\"\n[grid]\n\"materials.plate.elastic.poisson\" = [0, 0.3]\n"
            "\"cloud.spacing\" = [\"0.5 mm\", \"0.25 mm\", \"1/8 mm\"]\n");
  std::vector<std::string> names;
  for (const StudyRun& r : s.runs) names.push_back(r.name);
  EXPECT_EQ(names, (std::vector<std::string>{"poisson_0-spacing_0.5_mm", "poisson_0-spacing_0.25_mm",
                                             "poisson_0-spacing_1_8_mm", "poisson_0.3-spacing_0.5_mm",
                                             "poisson_0.3-spacing_0.25_mm", "poisson_0.3-spacing_1_8_mm"}));
  EXPECT_EQ(s.name, "loads");
  ASSERT_EQ(s.runs[4].changes().size(), 3U);
  EXPECT_EQ(s.runs[4].changes()[0].key, "time.end");
  EXPECT_EQ(s.runs[4].find("materials.plate.elastic.poisson")->real, 0.3);
  EXPECT_EQ(s.runs[4].find("cloud.spacing")->text, "0.25 mm");
}

TEST_F(Sweep, keys_that_end_alike_are_told_apart) {
  const Study s = study("[grid]\n\"tools.punch.fillet\" = [1]\n\"tools.die.fillet\" = [2]\n");
  EXPECT_EQ(s.runs.front().name, "punch.fillet_1-die.fillet_2");
}

TEST_F(Sweep, mistakes_in_the_study_name_its_file_and_line) {
  expect_parts(refusal("colums = []\n[grid]\n\"cloud.spacing\" = [\"0.5 mm\"]\n"),
               {"loads.toml:2:1", "key 'colums'", "did you mean 'columns'?"});
  expect_parts(refusal("[grid]\n\"cloud.spacing\" = [\"0.5 mm\"]\n\"cloud.spacin\" = [\"0.5 mm\"]\n"),
               {"loads.toml:4:", "cloud.spacin", "cloud.spacing", "in run"});
  expect_parts(refusal("[grid]\n\"cloud.spacing\" = [\"0.5 mm\",\n \"0.5 kg\"]\n"),
               {"loads.toml:4:2", "cloud.spacing", "a length"});
  expect_parts(refusal("[grid]\ncloud.spacing = [\"0.5 mm\"]\n"), {"loads.toml:3:1", "in quotes"});
  expect_parts(refusal("processes = 0\n[grid]\n\"cloud.spacing\" = [\"0.5 mm\"]\n"),
               {"loads.toml:2:", "processes"});
  expect_parts(refusal("columns = [\"node\"]\n[grid]\n\"cloud.spacing\" = [\"0.5 mm\"]\n"),
               {"loads.toml:2:", "did you mean 'nodes'?"});
  expect_parts(refusal("[grid]\n\"cloud.spacing\" = [\"1 mm\", \"1 mm\"]\n"),
               {"loads.toml:3:", "two runs named"});
  expect_parts(refusal("charts = [{ x = \"method.functions\", y = [\"nodes\"] "
                       "}]\n[grid]\n\"method.functions\" = [\"sibson\"]\n"),
               {"loads.toml:4:", "expected a number"});
  expect_parts(refusal(""), {"grid", "[[run]]"});
  expect_parts(refusal("[[run]]\nname = \"a/b\"\n"), {"loads.toml:3:", "a/b", "folder"});
  EXPECT_FALSE(fs::exists(out())) << "nothing is written before all is read";
}

constexpr const char* two_spacings = R"toml(
processes = 2
charts = [{ x = "cloud.spacing", y = ["metrics.strain_energy"] }]
history = ["energy.elastic"]
[grid]
"cloud.spacing" = ["0.5 mm", "0.25 mm"]
)toml";

TEST_F(Sweep, leaves_manifest_table_report_and_a_folder_per_run) {
  ASSERT_EQ(run(study(two_spacings)), 0) << message;
  for (const char* name : {"manifest.json", "table.csv", "report.html", "spacing_0.5_mm/status.json",
                           "spacing_0.25_mm/report.html", "spacing_0.5_mm.log"})
    EXPECT_TRUE(fs::exists(out() / name)) << name;
  const std::string table = results::read_file(out() / "table.csv");
  EXPECT_TRUE(table.starts_with("run,cloud.spacing,state,exit,nodes,steps,energy_residual,metrics."))
      << table;
  EXPECT_NE(table.find("\nspacing_0.5_mm,0.5 mm,done,0,"), std::string::npos) << table;
  // Uniform tension: the energy σ²/(2E)·A of both, whatever the spacing.
  for (const char* name : {"spacing_0.5_mm", "spacing_0.25_mm"}) {
    const results::RunStatus status = results::read_status(out() / name);
    EXPECT_NEAR(*status_number(status, "metrics.strain_energy"), 0.5 * 1e6 / 1e6 * 2e-6, 1e-14);
    EXPECT_EQ(status.threads, 1);
  }
  const std::string report = results::read_file(out() / "report.html");
  expect_parts(report, {"strain_energy against spacing", "spacing [mm]", "2 of 2 runs done",
                        "spacing_0.25_mm/report.html", "energy.elastic"});
  EXPECT_EQ(report.find("http"), std::string::npos) << "it needs nothing from elsewhere";
}

TEST_F(Sweep, tells_what_its_runs_were_warned_of) {
  const Study input = study(two_spacings);
  std::vector<RunRecord> runs(2);
  for (RunRecord& run : runs) run.status.emplace();
  for (RunRecord& run : runs) run.status->warnings = {"tools overlap"};
  runs[1].status->warnings.emplace_back("metal melts");
  EXPECT_EQ(warnings_of_runs(input, runs),
            (std::vector<std::string>{"spacing_0.5_mm and 1 more of 2 runs: tools overlap",
                                      "spacing_0.25_mm: metal melts"}));
}

TEST_F(Sweep, a_column_that_no_history_has_is_told) {
  std::string text = two_spacings;
  text.replace(text.find("elastic"), 7, "elastik");
  ASSERT_EQ(run(study(text)), 0) << message;
  EXPECT_NE(message.find("has no column 'energy.elastik' (did you mean 'energy.elastic'?)"),
            std::string::npos)
      << message;
}

TEST_F(Sweep, goes_on_where_it_stopped) {
  const auto written = [&](const char* name) { return fs::last_write_time(out() / name / "status.json"); };
  ASSERT_EQ(run(study(two_spacings)), 0) << message;
  const auto coarse = written("spacing_0.5_mm"), fine = written("spacing_0.25_mm");
  ASSERT_EQ(run(study(two_spacings)), 0);
  expect_parts(printed, {"2 done before, 0 to do"});
  EXPECT_EQ(written("spacing_0.5_mm"), coarse);

  fs::remove(out() / "spacing_0.5_mm" / "status.json");
  ASSERT_EQ(run(study(two_spacings)), 0);
  expect_parts(printed, {"1 done before, 1 to do", "spacing_0.5_mm: done"});
  EXPECT_NE(written("spacing_0.5_mm"), coarse);
  EXPECT_EQ(written("spacing_0.25_mm"), fine);

  // Other inputs under the same name are not done: a change of [set], and one of the case.
  ASSERT_EQ(run(study(std::string(two_spacings) + "[set]\n\"materials.plate.elastic.poisson\" = 0.2\n")), 0);
  expect_parts(printed, {"0 done before, 2 to do"});
  std::ofstream(folder / "plate" / "case.toml", std::ios::app) << "[loads]\nbody_force = \"1 0 m/s2\"\n";
  ASSERT_EQ(run(study(std::string(two_spacings) + "[set]\n\"materials.plate.elastic.poisson\" = 0.2\n")), 0);
  expect_parts(printed, {"0 done before, 2 to do"});
  ASSERT_EQ(
      run(study(std::string(two_spacings) + "[set]\n\"materials.plate.elastic.poisson\" = 0.2\n"), true), 0);
  expect_parts(printed, {"0 done before, 2 to do"});
}

TEST_F(Sweep, a_run_that_fails_is_named_and_stops_no_other) {
  // The corner alone leaves a free rotation, which only the solver sees.
  const char* text = R"toml(
[[run]]
name = "free"
set = { "boundary.left.displacement" = { y = "0 m" }, "boundary.corner.points" = ["0 1 mm"], "boundary.corner.displacement" = { y = "0 m" } }
[[run]]
name = "held"
)toml";
  EXPECT_EQ(run(study(text)), 3) << printed << message;
  expect_parts(message, {"failed: free: ", "exit code 2", "free.log", "boundary"});
  expect_parts(printed, {"held: done", "free: FAILED"});
  expect_parts(results::read_file(out() / "table.csv"), {"\nfree,", ",failed,2,", "\nheld,", ",done,0,"});
  expect_parts(results::read_file(out() / "report.html"), {"free failed: ", "1 of 2 runs done, 1 failed"});
  EXPECT_EQ(run(study(text)), 3) << "a failed run is tried again";
  expect_parts(printed, {"1 done before, 1 to do"});
}

TEST_F(Sweep, the_folder_of_a_single_run_is_left_alone) {
  fs::create_directories(out());
  std::ofstream(out() / "status.json") << "{}";
  expect_parts(refusal(two_spacings), {"holds a single run", "--output"});
}

TEST_F(Sweep, a_signal_ends_the_children_and_is_told) {
  const std::vector<Job> jobs(3, Job{{"/bin/sh", "-c", "sleep 100"}, folder / "sleep.log"});
  int ended = 0;
  std::size_t begun = 0;
  const bool complete = run_jobs(
      jobs, 2,
      [&](std::size_t job) {
        begun = job + 1;
        if (begun == 2) ::kill(::getpid(), SIGTERM);
      },
      [&](std::size_t, JobEnd) { ++ended; });
  EXPECT_FALSE(complete);
  EXPECT_EQ(begun, 2U);
  EXPECT_EQ(ended, 0);
}

TEST_F(Sweep, a_sweep_that_is_terminated_exits_with_5_and_keeps_what_is_done) {
  // The second run takes many seconds; the signal comes as soon as the first one is done.
  std::ofstream(folder / "study.toml") << "case = \"plate\"\nprocesses = 1\n[grid]\n"
                                          "\"cloud.spacing\" = [\"0.5 mm\", \"0.005 mm\"]\n";
  const std::string command =
      "'" CNEM_PROGRAM "' sweep " + folder.string() + " --output " + out().string() +
      " > /dev/null 2>&1 & sweep=$!; tries=0; until grep -q '\"done\"' " +
      (out() / "manifest.json").string() +
      " || [ $tries -gt 400 ]; do sleep 0.05; tries=$((tries + 1)); done 2> /dev/null; kill -TERM $sweep; "
      "wait $sweep";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  EXPECT_NE(results::read_file(out() / "table.csv").find("spacing_0.005_mm,0.005 mm,pending"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(out() / "spacing_0.005_mm" / "status.json"));
  ASSERT_EQ(run(study("[grid]\n\"cloud.spacing\" = [\"0.5 mm\"]\n")), 0);
  expect_parts(printed, {"1 done before, 0 to do"});
}

TEST_F(Sweep, wrong_usage_exits_with_2) {
  const auto code = [&](const std::string& arguments) {
    const int status = std::system(("'" CNEM_PROGRAM "' sweep " + arguments + " > /dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(code((folder / "absent.toml").string()), 2);
  std::ofstream(folder / "study.toml") << "case = \"absent\"\n[[run]]\nname = \"a\"\n";
  EXPECT_EQ(code(folder.string()), 2);
  EXPECT_EQ(code(folder.string() + " --processes 0"), 2);
}

TEST_F(Sweep, jobs_report_their_code_signal_and_output) {
  const std::vector<Job> jobs{{{"/bin/sh", "-c", "echo one; exit 7"}, folder / "a.log"},
                              {{"/bin/sh", "-c", "kill -9 $$"}, folder / "b.log"},
                              {{"/nowhere/program"}, folder / "c.log"}};
  std::vector<JobEnd> end(3);
  EXPECT_TRUE(run_jobs(
      jobs, 2, [](std::size_t) {}, [&](std::size_t job, JobEnd how) { end[job] = how; }));
  EXPECT_EQ(end[0].code, 7);
  EXPECT_EQ(end[1].signal, 9);
  EXPECT_EQ(end[2].code, 127);
  EXPECT_EQ(results::read_file(folder / "a.log"), "one\n");
}

TEST_F(Sweep, texts_in_the_table_are_no_formulas) {
  const Study s =
      study("[[run]]\nname = \"+A1\"\nset = { \"title\" = \"@SUM(A1)\", \"x\" = \"-11 m/s\" }\n"
            "[[run]]\nname = \"b\"\nset = { \"title\" = \"\\t=2\", \"x\" = \"-1+cmd|' /C calc'!A0\" }\n"
            "[[run]]\nname = \"c\"\nset = { \"title\" = \"+A1,2\", \"x\" = -3.5 }\n"
            "[[run]]\nname = \"d\"\nset = { \"title\" = \"\\r=2\", \"x\" = \"-1 +5 mm\" }\n");
  const std::string table = sweep_table(s, std::vector<RunRecord>(4));
  expect_parts(table, {"\n'+A1,'@SUM(A1),-11 m/s,", "\nb,'\t=2,'-1+cmd|' /C calc'!A0,",
                       "\nc,\"'+A1,2\",-3.5,", "\nd,\"'\r=2\",-1 +5 mm,"});
}

TEST_F(Sweep, extrapolates_along_the_two_finest) {
  const std::string grid = "[grid]\n\"cloud.spacing\" = [\"0.4 mm\", \"0.1 mm\", \"0.2 mm\"]\n";
  const auto with = [&](const char* options) {
    return study(fmt::format("charts = [{{ x = \"cloud.spacing\", y = [\"metrics.F\"]{} }}]\n", options) +
                 grid);
  };
  std::vector<RunRecord> runs(3);
  for (const auto& [k, force] : {std::pair{0, 17.0}, {1, 10.5}, {2, 11.0}})
    runs[static_cast<std::size_t>(k)].status.emplace().metrics = {{"F", force}};
  const Study asked = with(", extrapolate = true");
  EXPECT_EQ(extrapolations(asked, runs), "F: 10 at 0, from 10.5 at 0.1 and 11 at 0.2\n");
  expect_parts(sweep_report(asked, runs, out(), "test"), {"F: 10 at 0"});
  EXPECT_EQ(extrapolations(with(""), runs), "");
  EXPECT_EQ(extrapolations(with(", extrapolate = false"), runs), "");
  for (const std::size_t k : {1U, 2U}) runs[k].status.reset();
  EXPECT_EQ(extrapolations(asked, runs), "") << "one run is no line";
  expect_parts(refusal("charts = [{ x = \"cloud.spacing\", y = [\"nodes\"], extrapolate = 1 }]\n" + grid),
               {"loads.toml:2:", "true or false"});
}

} // namespace
} // namespace cnem::study
