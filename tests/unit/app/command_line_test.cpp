// The command line as a user calls it: exit codes, files, messages.
#include "tests/unit/app/command_line_fixture.hpp"

#include "input/case.hpp"
#include "results/fields.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"

#include <algorithm>
#include <sstream>

namespace cnem::app {
namespace {

TEST_F(CommandLine, a_run_of_heat_alone_closes_the_balance_of_heat) {
  const std::filesystem::path path = folder / "warm.toml";
  std::ofstream(path) << testing::steel_304l << R"toml(
[analysis]
mechanical = false
[time]
end = "1 ms"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "2 1 mm" }
[cloud]
spacing = "0.2 mm"
[initial]
temperature = "300 K"
[boundary.hot]
pieces = ["left"]
temperature = "400 K"
)toml";
  ASSERT_EQ(call({"run", path.string(), "--output", results(), "--threads", "1"}), 0) << message;
  EXPECT_NE(printed.find("; heat residual "), std::string::npos) << printed;
  EXPECT_NE(printed.find(" of the heat moved"), std::string::npos) << printed;
  const double share = results::read_status(results()).energy_residual;
  EXPECT_LT(share, 1e-10);
  const std::string page = results::read_file(folder / "results" / "report.html");
  EXPECT_NE(page.find("heat residual "), std::string::npos);
  EXPECT_EQ(page.find("energy residual"), std::string::npos);
  EXPECT_EQ(page.find("Residual of the energy balance"), std::string::npos) << "it is zero";
  EXPECT_NE(page.find("<dt>Largest temperature</dt><dd>400\u00a0K</dd>"), std::string::npos);
}

TEST_F(CommandLine, run_leaves_every_promised_file_and_closes_its_books) {
  ASSERT_EQ(call({"run", file(), "--output", results(), "--threads", "1"}), 0) << message;
  for (const char* name : {"case.resolved.toml", "history.csv", "fields.pvd", "status.json", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder / "results" / name)) << name;
  const results::RunStatus status = results::read_status(results());
  EXPECT_EQ(status.exit, 0);
  EXPECT_LT(status.energy_residual, 5e-3);
  const results::HistoryTable history = results::read_history(folder / "results" / "history.csv");
  EXPECT_EQ(history.names.front(), "time[s]");
  EXPECT_NEAR(history.column.front().back(), 2e-6, 1e-15);
  EXPECT_EQ(history.rows(), 21U);
  for (const char* name :
       {"punch.force_y", "punch.stroke", "energy.residual", "max.plastic_strain", "mass", "area"})
    EXPECT_GE(history.find(name), 0) << name;
  // The resolved case is a case: it runs to the same bits.
  ASSERT_EQ(call({"run", (folder / "results" / "case.resolved.toml").string(), "--output",
                  (folder / "again").string(), "--threads", "1"}),
            0)
      << message;
  EXPECT_EQ(results::read_history(folder / "again" / "history.csv").column, history.column);
}

TEST_F(CommandLine, status_splits_the_wall_time_and_profile_prints_it) {
  ASSERT_EQ(call({"run", file(), "--output", results(), "--threads", "1", "--profile"}), 0) << message;
  EXPECT_NE(printed.find("ns/node-step"), std::string::npos) << printed;
  EXPECT_NE(printed.find("\n  stress "), std::string::npos) << printed;
  const results::RunStatus status = results::read_status(results());
  const auto wall = [&](const std::string& phase) {
    for (const auto& [name, seconds] : status.wall_s)
      if (name == phase) return seconds;
    ADD_FAILURE() << "no phase " << phase;
    return 0.0;
  };
  double step = 0.0, output = 0.0;
  for (const char* part : {"motion", "contact", "stress", "forces", "heat", "stable"}) {
    EXPECT_GT(wall(std::string("step.") + part), 0.0) << part;
    step += wall(std::string("step.") + part);
  }
  for (const char* part : {"history", "fields", "pictures", "checkpoint", "disk", "report"})
    output += wall(std::string("output.") + part);
  EXPECT_LE(step, wall("step"));
  EXPECT_GT(step, 0.5 * wall("step"));
  EXPECT_LE(output, wall("output"));
  EXPECT_GT(wall("output.report"), 0.0);
  EXPECT_LE(wall("setup") + wall("step") + wall("rebuild") + wall("output"), wall("total"));
  ASSERT_EQ(call({"run", file(), "--output", results(), "--threads", "1", "--force"}), 0) << message;
  EXPECT_EQ(printed.find("ns/node-step"), std::string::npos) << printed;
}

TEST_F(CommandLine, a_folder_that_holds_a_run_is_kept_unless_forced) {
  ASSERT_EQ(call({"run", file(), "--output", results()}), 0);
  EXPECT_EQ(call({"run", file(), "--output", results()}), 2);
  EXPECT_NE(message.find("--force"), std::string::npos);
  EXPECT_EQ(call({"run", file(), "--output", results() + "/", "--force", "--set", "time.end=1 us"}), 0);
  EXPECT_NEAR(results::read_status(results()).time, 1e-6, 1e-15);
  EXPECT_EQ(call({"report", results()}), 0);
}

TEST_F(CommandLine, a_report_is_not_made_of_less_than_the_run_has_written) {
  ASSERT_EQ(call({"run", file(), "--output", results()}), 0);
  const std::filesystem::path history = folder / "results" / results::files::history;
  const std::string rows = results::read_file(history),
                    page = results::read_file(folder / "results" / results::files::report);
  std::ofstream(history) << rows.substr(0, rows.find('\n', rows.size() / 2) + 1);
  EXPECT_EQ(call({"report", results()}), 4);
  EXPECT_NE(message.find("is cut short: it ends at"), std::string::npos) << message;
  std::filesystem::remove(history);
  EXPECT_EQ(call({"report", results()}), 4);
  EXPECT_NE(message.find("is missing"), std::string::npos) << message;
  EXPECT_EQ(results::read_file(folder / "results" / results::files::report), page);
  EXPECT_EQ(call({"report", (folder / "absent").string()}), 2);
  EXPECT_NE(message.find("holds no run"), std::string::npos) << message;
}

TEST_F(CommandLine, pictures_of_somebody_else_are_not_replaced) {
  std::filesystem::create_directories(folder / "results" / "pictures");
  const std::filesystem::path mine = folder / "results" / "pictures" / "pressure_000.png";
  std::ofstream(mine) << "mine";
  for (const std::vector<std::string>& force : {std::vector<std::string>{}, {"--force"}}) {
    std::vector<std::string> words{"run", file(), "--output", results()};
    words.insert(words.end(), force.begin(), force.end());
    EXPECT_EQ(call(words), 2);
    EXPECT_NE(message.find("which a run would replace, and no run"), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::exists(mine));
}

TEST_F(CommandLine, slips_in_names_of_tools_are_named) {
  EXPECT_EQ(call({"check", file(), "--set", "tools.punsh.velocity=0 -5 m/s"}), 2);
  EXPECT_NE(message.find("the case has no tools.punsh (did you mean 'punch'?)"), std::string::npos)
      << message;
}

TEST_F(CommandLine, a_fixed_step_beyond_the_stable_one_is_doubted) {
  ASSERT_EQ(call({"check", file(), "--output", results(), "--set", "time.step.fixed=1 us"}), 0);
  EXPECT_NE(printed.find("times the longest step with which waves do not grow"), std::string::npos)
      << printed;
  ASSERT_EQ(call({"check", file(), "--output", results(), "--set", "time.step.fixed=10 ns"}), 0);
  EXPECT_EQ(printed.find("time.step.fixed"), std::string::npos) << printed;
}

TEST_F(CommandLine, the_folder_of_a_study_says_its_command) {
  std::ofstream(folder / "study.toml") << "case = \"block.toml\"\n";
  EXPECT_EQ(call({"check", folder.string()}), 2);
  EXPECT_NE(message.find("study.toml, for `cnem sweep`"), std::string::npos) << message;
}

TEST_F(CommandLine, wrong_input_and_usage_exit_with_2) {
  EXPECT_EQ(call({"run", (folder / "absent.toml").string()}), 2);
  EXPECT_EQ(call({"run"}), 2);
  EXPECT_EQ(call({"chek", file()}), 2);
  EXPECT_NE(message.find("found 'chek', expected a command, one of run, check, explain"), std::string::npos)
      << message;
  EXPECT_NE(message.find("(did you mean 'check'?)"), std::string::npos) << message;
  EXPECT_EQ(call({}), 2);
  EXPECT_NE(message.find("expected a command, one of run, check"), std::string::npos) << message;
  EXPECT_EQ(call({"run", file(), "--threads", "0"}), 2);
  EXPECT_EQ(call({"sweep", "study.toml", "--merge", "--processes", "4"}), 2); // a merge runs nothing
  EXPECT_NE(message.find("--processes excludes --merge"), std::string::npos) << message;
  EXPECT_EQ(call({"check", file(), "--set", "cloud.spacin=0.1 mm"}), 2);
  EXPECT_NE(message.find("cloud.spacing"), std::string::npos) << message;
  EXPECT_EQ(call({"check", file(), "--set", "cloud.spacing=1e-8 m"}), 2);
  EXPECT_EQ(call({"check", file(), "--set", "method.name=fe-triangles", "--set", "adapt.resample=true"}), 2);
  EXPECT_NE(message.find("one stress point per node"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists("results/block"));
}

TEST_F(CommandLine, a_folder_of_cases_names_them) {
  for (const char* name : {"thin", "thick"}) {
    std::filesystem::create_directories(folder / "cases" / name);
    std::ofstream(folder / "cases" / name / "case.toml") << block;
  }
  EXPECT_EQ(call({"run", (folder / "cases").string()}), 2);
  EXPECT_NE(message.find("holds no case.toml itself, expected a case, one of its folders thick, thin"),
            std::string::npos)
      << message;
}

TEST_F(CommandLine, a_run_that_was_killed_is_offered_to_go_on) {
  ASSERT_EQ(call({"run", file(), "--output", results(), "--set", "output.checkpoint.every_time=0.5 us"}), 0);
  EXPECT_EQ(call({"run", file(), "--output", results()}), 2);
  EXPECT_EQ(message.find("restart"), std::string::npos) << message;
  std::filesystem::remove(folder / "results" / results::files::status);
  EXPECT_EQ(call({"run", file(), "--output", results()}), 2);
  EXPECT_NE(message.find("`cnem restart` goes on with it"), std::string::npos) << message;
}

TEST_F(CommandLine, unwritable_output_exits_with_4) {
  EXPECT_EQ(call({"run", file(), "--output", "/proc/cnem"}), 4);
}

TEST_F(CommandLine, notes_stand_beside_their_pictures) {
  const std::string noted = (folder / "noted.toml").string();
  std::ofstream(noted)
      << std::ifstream(file()).rdbuf()
      << "[output.notes.end]\nat = \"2 us\"\nfield = \"temperature\"\ntext = \"what < is\"\n";
  ASSERT_EQ(call({"run", noted, "--output", results(), "--set", "output.pictures=1 2 us", "--set",
                  "output.picture_fields=[\"plastic_strain\", \"temperature\"]"}),
            0)
      << message;
  std::stringstream report;
  report << std::ifstream(folder / "results" / "report.html").rdbuf();
  const std::string text = report.str(), caption = "<figcaption>what &lt; is</figcaption>";
  const std::size_t found = text.find(caption);
  ASSERT_NE(found, std::string::npos);
  EXPECT_EQ(text.find(caption, found + 1), std::string::npos) << "once";
  EXPECT_GT(found, text.find("alt=\"temperature at 2 "));
}

TEST_F(CommandLine, statics_beyond_yield_is_told) {
  EXPECT_EQ(call({"run", pulled(), "--output", results()}), 0) << message;
  EXPECT_TRUE(results::read_status(results()).warnings.empty());
  EXPECT_EQ(
      call({"run", pulled(), "--output", results(), "--force", "--set", "boundary.top.traction=0 400 MPa"}),
      0);
  ASSERT_EQ(results::read_status(results()).warnings.size(), 1U);
  EXPECT_NE(results::read_status(results()).warnings[0].find("above the yield stress of steel, 1e+08 Pa"),
            std::string::npos);
}

TEST_F(CommandLine, an_integral_within_a_spacing_of_the_tip_is_refused) {
  const auto with_outer = [&](const std::string& outer) {
    return call({"run", pulled(), "--output", results(), "--force", "--set",
                 R"(domain.cracks.c.points=["0 1 mm", "2 1 mm"])", "--set",
                 "fracture.integral.outer=" + outer});
  };
  EXPECT_EQ(with_outer("0.3 mm"), 2);
  EXPECT_NE(message.find("key 'fracture.integral.outer': found 0.0003 m, expected at least 2 spacings"),
            std::string::npos)
      << message;
  EXPECT_FALSE(std::filesystem::exists(results())) << "refused before the folder is taken";
  EXPECT_EQ(with_outer("0.6 mm"), 0) << message;
}

TEST_F(CommandLine, no_number_of_threads_is_told_in_words) {
  EXPECT_EQ(call({"run", file(), "--threads", "0"}), 2);
  EXPECT_NE(message.find("found 0, expected a whole number from 1 to 2147483647"), std::string::npos)
      << message;
}

TEST_F(CommandLine, a_forced_run_leaves_no_file_of_the_run_before) {
  EXPECT_EQ(call({"run", file(), "--output", results(), "--set", "time.max_steps=1"}), 0) << message;
  const auto log = std::filesystem::path(results()) / "adaptation.csv";
  std::ofstream(log) << "of another run\n";
  EXPECT_EQ(call({"run", file(), "--output", results(), "--force", "--set", "time.max_steps=1"}), 0)
      << message;
  EXPECT_FALSE(std::filesystem::exists(log));
}

TEST_F(CommandLine, metal_that_melts_is_warned_of_once) {
  ASSERT_EQ(
      call({"run", file(), "--output", results(), "--set", "tools.punch.velocity=0 0 m/s", "--set",
            "boundary.top={ pieces = [\"top\"], temperature = \"1800 K\" }", "--set", "time.max_steps=25"}),
      0)
      << message;
  const std::vector<std::string> warnings = results::read_status(results()).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  for (const char* part : {"node ", "1800 K", "1698 K of steel", "step ", "t = "})
    EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
  const std::size_t told = message.find(warnings[0]);
  ASSERT_NE(told, std::string::npos) << message;
  EXPECT_EQ(message.find("melting", told + warnings[0].size()), std::string::npos) << message;
  std::ifstream report(folder / "results" / "report.html");
  const std::string html{std::istreambuf_iterator<char>(report), {}};
  EXPECT_NE(html.find("above the melting temperature"), std::string::npos);
  ASSERT_EQ(call({"run", file(), "--output", results(), "--force", "--set", "time.max_steps=25"}), 0);
  EXPECT_TRUE(results::read_status(results()).warnings.empty());
}

TEST_F(CommandLine, a_run_may_end_after_so_many_steps) {
  ASSERT_EQ(call({"run", file(), "--output", results(), "--set", "time.max_steps=7", "--set",
                  "output.history_every=0 s"}),
            0)
      << message;
  const results::RunStatus status = results::read_status(results());
  EXPECT_EQ(status.steps, 7);
  EXPECT_EQ(status.reason, "reached time.max_steps");
  const results::HistoryTable history = results::read_history(folder / "results" / "history.csv");
  EXPECT_EQ(history.rows(), 8U) << "0: a row at every step";
  EXPECT_EQ(history.column[0].back(), status.time);
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "fields" / "cells_00001.vtu")) << "the last state";
}

TEST_F(CommandLine, check_says_what_a_run_would_be) {
  ASSERT_EQ(call({"check", file(), "--output", results()}), 0) << message;
  for (const char* word : {"nodes", "first step", "elastic waves", "steps", "memory", "tools"})
    EXPECT_NE(printed.find(word), std::string::npos) << word;
  EXPECT_TRUE(std::filesystem::exists(folder / "results" / "initial" / "fields.pvd"));
  ASSERT_EQ(call({"check", file(), "--output", results(), "--set", "tools.punch.rectangle.from=-1 1.9 mm"}),
            0);
  EXPECT_NE(printed.find("overlap"), std::string::npos);
}

TEST(FieldCatalogue, is_the_one_the_case_reader_knows) {
  std::vector<std::string> names;
  for (const FieldInfo<2>& info : field_catalogue<2>()) names.push_back(info.name);
  std::vector<std::string> known = input::field_names(2);
  std::sort(names.begin(), names.end());
  std::sort(known.begin(), known.end());
  EXPECT_EQ(names, known);
}

} // namespace
} // namespace cnem::app
