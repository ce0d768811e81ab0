// What a run reports of a cut: forces and work beside the ledger, the sheet as a whole, springback.
#include "app/command_line.hpp"
#include "core/index.hpp"
#include "evaluate/blanking.hpp"
#include "evaluate/blanking_result.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

namespace cnem::evaluate {

namespace {

constexpr const char* small_cut = R"toml(
title = "small cut"
[analysis]
thermal = false
[time]
end = "4 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "6 2 mm" }
[cloud]
spacing = "0.25 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
[boundary.symmetry]
pieces = "left"
symmetry = true
[tools.punch]
rectangle = { from = "-1 2 mm", to = "2 4 mm" }
velocity = { value = "0 -40 m/s", ramp = "1 us" }
[tools.die]
rectangle = { from = "2.1 -2 mm", to = "8 0 mm" }
[report.blanking]
[output]
history_every = "0 s"
fields_every = "2 us"
)toml";

class BlankingRun : public ::testing::Test {
protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("cnem_blanking_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void run(const std::string& text, std::vector<std::string> more = {}) {
    std::ofstream(folder / "case.toml") << text;
    std::vector<std::string> words{"cnem",
                                   "run",
                                   (folder / "case.toml").string(),
                                   "--output",
                                   (folder / "results").string(),
                                   "--force",
                                   "--threads",
                                   "1"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = app::command_line(static_cast<int>(argv.size()), argv.data());
    ::testing::internal::GetCapturedStdout();
    const std::string message = ::testing::internal::GetCapturedStderr();
    ASSERT_EQ(code, 0) << message;
    status = results::read_status(folder / "results");
  }
  double metric(const std::string& name) const {
    for (const auto& [known, value] : status.metrics)
      if (known == name) return value;
    ADD_FAILURE() << "no metric " << name;
    return std::nan("");
  }
  bool has_metric(const std::string& name) const {
    return std::any_of(status.metrics.begin(), status.metrics.end(),
                       [&](const auto& entry) { return entry.first.starts_with(name); });
  }
  results::HistoryTable history() const { return results::read_history(folder / "results" / "history.csv"); }

  std::filesystem::path folder;
  results::RunStatus status;
};

TEST_F(BlankingRun, work_is_force_over_stroke_and_what_the_ledger_received) {
  run(small_cut);
  const results::HistoryTable table = history();
  const auto column = [&](const std::string& name) { return table.column[index_of(table.find(name))]; };
  const std::vector<double> work = column("punch.work"), force = column("punch.force_y"),
                            at = column("punch.displacement_y"), books = column("energy.tool_work");
  EXPECT_EQ(metric("blanking.work.punch"), work.back());
  EXPECT_EQ(metric("blanking.work.die"), 0.0);
  EXPECT_NEAR(work.back(), books.back(), 1e-12 * books.back());
  double sum = 0.0;
  for (std::size_t k = 1; k < at.size(); ++k)
    sum += force[k] * (at[k] - at[k - 1]); // force of the step that led there
  EXPECT_NEAR(sum / work.back(), 1.0, 0.01);
  EXPECT_GT(metric("blanking.largest_force.punch"), 0.0);
  EXPECT_LE(metric("blanking.largest_force.punch"), metric("peak_force.punch"));
  EXPECT_LE(metric("blanking.stroke_at_largest_force.punch"), metric("blanking.stroke"));
  EXPECT_NEAR(metric("blanking.stroke"), 40.0 * 3.5e-6, 1e-9);
}

TEST_F(BlankingRun, whole_sheet_is_reported_as_such_and_lets_go) {
  run(small_cut);
  const auto blanking = read_blanking(folder / "results");
  ASSERT_TRUE(blanking);
  ASSERT_EQ(blanking->faces.size(), 2U);
  EXPECT_FALSE(blanking->faces[0].parted);
  EXPECT_EQ(metric("blanking.slug.parted"), 0.0);
  EXPECT_GT(metric("blanking.skeleton.rollover") + metric("blanking.skeleton.burnish"), 0.02e-3);
  EXPECT_LT(metric("blanking.skeleton.rollover") + metric("blanking.skeleton.burnish"), 0.2e-3);
  EXPECT_EQ(metric("blanking.skeleton.fracture"), 0.0);
  // Elastic strains of about 400 MPa/210 GPa over millimetres.
  EXPECT_GT(metric("springback.largest"), 0.1e-6);
  EXPECT_LT(metric("springback.largest"), 50e-6);
  EXPECT_GE(metric("springback.largest"), metric("springback.slug.largest"));
  const std::string last = results::read_file(folder / "results" / "fields" / "nodes_00002.vtu");
  EXPECT_NE(last.find("springback [m]"), std::string::npos);
  EXPECT_EQ(results::read_file(folder / "results" / "fields" / "nodes_00001.vtu").find("springback"),
            std::string::npos);
  const std::string report = results::read_file(folder / "results" / "report.html");
  for (const char* part :
       {"id=\"blanking\"", "Face of the slug", "Face of the skeleton", "Force along the cut against stroke",
        "drawn in only", "Dishing of slug", "<title>small cut</title>", "<dt>Largest force of punch</dt>",
        "\u00a0N/mm of depth, one cut</dd>", "<dt>Work of punch</dt>", "<dt>Cut through</dt>"})
    EXPECT_NE(report.find(part), std::string::npos) << part;
}

TEST_F(BlankingRun, springback_alone_and_nothing_at_all) {
  const std::string text(small_cut);
  const std::string without =
      text.substr(0, text.find("[report.blanking]")) + text.substr(text.find("[output]"));
  run(without);
  EXPECT_FALSE(has_metric("blanking"));
  EXPECT_FALSE(has_metric("springback"));
  EXPECT_FALSE(std::filesystem::exists(folder / "results" / results::files::blanking));
  run(without, {"--set", "report.springback=true", "--set", "time.max_steps=20"});
  EXPECT_GT(metric("springback.body_1.largest"), 0.0);
  EXPECT_FALSE(has_metric("blanking"));
  run(text, {"--set", "report.springback=false"});
  EXPECT_FALSE(has_metric("springback"));
  EXPECT_TRUE(has_metric("blanking.slug"));
}

TEST_F(BlankingRun, a_punch_that_has_not_moved_is_said) {
  run(small_cut, {"--set", "tools.punch.velocity=0 0 m/s", "--set", "time.max_steps=5"});
  const auto blanking = read_blanking(folder / "results");
  ASSERT_TRUE(blanking);
  EXPECT_EQ(blanking->note, "punch has not moved");
  EXPECT_TRUE(blanking->faces.empty());
}

} // namespace
} // namespace cnem::evaluate
