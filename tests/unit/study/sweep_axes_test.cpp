// What the runs of a study differ in: variables of the case, linked keys, and the axes and heads made of
// them.
#include "core/error.hpp"
#include "results/output_folder.hpp"
#include "study/sweep.hpp"
#include "tests/temporary_folder.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* strip = R"toml(
[let]
width = "2 mm"
height = "width / 2"
pull = "1 kPa"
[analysis]
type = "static"
kinematics = "plane stress"
[domain]
material = "rubber"
outer.rectangle = { from = "0 0 mm", to = ["width", "height"] }
[cloud]
spacing = "height / 2"
[materials.rubber]
density = "1000 kg/m3"
elastic = { young = "1 MPa", poisson = 0.3 }
[boundary]
right = { pieces = ["right"], traction = "pull, 0 kPa" }
left = { pieces = ["left"], displacement.x = "0 m" }
corner = { points = ["0 0 mm"], displacement = "0 0 m" }
)toml";

class SweepAxes : public ::testing::Test {
protected:
  void SetUp() override { std::ofstream(folder / "case.toml") << strip; }

  Study study(const std::string& text) const {
    return read_study_text("case = \"case.toml\"\n" + text, folder / "loads.toml");
  }
  std::string refusal(const std::string& text) const {
    try {
      (void)study(text);
    } catch (const InputError& error) { return std::string(error.what()).substr(folder.string().size() + 1); }
    return "accepted";
  }
  /// The table and the page of a study that was run.
  std::string results_of(const Study& input) const {
    std::exception_ptr problem;
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    try {
      sweep(input, {.output = folder / "results", .program = CNEM_PROGRAM, .version = "test"});
    } catch (...) { problem = std::current_exception(); }
    ::testing::internal::GetCapturedStdout();
    ::testing::internal::GetCapturedStderr();
    if (problem) std::rethrow_exception(problem);
    return results::read_file(folder / "results" / "table.csv") +
           results::read_file(folder / "results" / "report.html");
  }
  static void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << "\nin " << text;
  }

  const cnem::testing::TemporaryFolder temporary{"sweep_axes"};
  const fs::path& folder = temporary.path();
};

constexpr const char* linked = R"toml(
[[axis]]
name = "size"
set = { "let.width" = ["1 mm", "2 mm"], "let.pull" = ["2 kPa", "1 kPa"] }
)toml";

TEST_F(SweepAxes, keys_of_one_axis_change_together) {
  const Study s = study(std::string("[grid]\n\"method.functions\" = [\"sibson\", \"laplace\"]\n") + linked);
  std::vector<std::string> names;
  for (const StudyRun& run : s.runs) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"functions_sibson-size_1_mm", "functions_sibson-size_2_mm",
                                             "functions_laplace-size_1_mm", "functions_laplace-size_2_mm"}));
  EXPECT_EQ(s.keys, (std::vector<std::string>{"method.functions", "let.width", "let.pull"}));
  EXPECT_EQ(s.runs[2].find("let.width")->text, "1 mm");
  EXPECT_EQ(s.runs[2].find("let.pull")->text, "2 kPa");
  ASSERT_EQ(s.axes.size(), 2U);
  EXPECT_EQ(s.axis_of("let.pull"), &s.axes[1]);
  EXPECT_EQ(s.axis_of("size"), &s.axes[1]);
  EXPECT_EQ(s.axis_of("let.height"), nullptr);
}

TEST_F(SweepAxes, lists_of_an_axis_have_one_length_and_keys_one_axis) {
  EXPECT_EQ(refusal("[[axis]]\nname = \"a\"\nset = { \"let.width\" = [\"1 mm\"], \"let.pull\" = [1, 2] }\n"),
            "loads.toml:4:46: key 'axis.set.let.pull': found 2 values, expected 1 as of 'let.width', which "
            "changes with it");
  expect_parts(refusal(std::string("[grid]\n\"let.pull\" = [\"1 Pa\"]\n") + linked),
               {"found 'let.pull' on two axes, expected it on one"});
  expect_parts(refusal("[[axis]]\nname = \"a\"\n"), {"key 'axis.set': missing"});
  expect_parts(refusal("[[axis]]\nset = { \"let.pull\" = [1] }\n"), {"key 'axis.name': missing"});
  expect_parts(refusal("[[axis]]\nname = \"a\"\nset = {}\n"), {"key 'axis.set': empty"});
  expect_parts(refusal("[[axis]]\nname = \"a\"\nset = { \"let.pull\" = 1 }\n"),
               {"key 'axis.set.let.pull': found 1, expected a key of the case in quotes and a list"});
  expect_parts(refusal("axis = [3]\n"), {"key 'axis': found 3, expected a table [[axis]]"});
  expect_parts(refusal(std::string(linked) + "[[run]]\nname = \"b\"\n"),
               {"found [[axis]] and [[run]], expected one of them"});
}

TEST_F(SweepAxes, heads_and_axes_carry_names_and_units) {
  const std::string text =
      results_of(study(std::string("columns = [\"metrics.strain_energy\", \"nodes\", \"cpu_s\"]\n"
                                   "charts = [{ x = \"size\", y = [\"metrics.strain_energy\"] }, "
                                   "{ x = \"let.height\", y = [\"metrics.external_work\"] }]\n"
                                   "history = [{ x = \"energy.external\", y = \"energy.elastic\" }]\n") +
                       linked));
  expect_parts(text, {"run,let.width,let.pull,state,exit,metrics.strain_energy[J/m],nodes,cpu_s[s]",
                      "\nsize_1_mm,1 mm,2 kPa,done,0,", "<th>strain_energy [mJ/mm]</th>", "size [mm]",
                      "strain_energy against size", "height [mm]", "external_work against height",
                      "energy.elastic over energy.external"});
}

TEST_F(SweepAxes, values_may_be_expressions_of_other_variables) {
  const std::string text = results_of(study("charts = [{ x = \"let.height\", y = [\"nodes\"] }]\n"
                                            "[grid]\n\"let.height\" = [\"width / 2\", \"width\"]\n"));
  expect_parts(text, {"\nheight_width_2,width / 2,done,0,", "height [mm]", "nodes against height"});
}

TEST_F(SweepAxes, variables_that_the_case_does_not_define_are_refused) {
  const Study s = study("[grid]\n\"let.widht\" = [\"1 mm\"]\n");
  try {
    (void)results_of(s);
    FAIL();
  } catch (const InputError& error) {
    expect_parts(error.what(),
                 {"loads.toml:3:", "key 'let.widht': the case does not define it", "did you mean 'width'?"});
  }
}

TEST_F(SweepAxes, charts_over_variables_that_no_case_has_are_refused) {
  const Study s =
      study("charts = [{ x = \"let.hight\", y = [\"nodes\"] }]\n[grid]\n\"let.width\" = [\"1 mm\"]\n");
  try {
    (void)results_of(s);
    FAIL();
  } catch (const InputError& error) {
    expect_parts(error.what(),
                 {"found \"let.hight\", expected a variable of the case (did you mean 'let.height'?)"});
  }
}

TEST_F(SweepAxes, axes_have_names_and_keys) {
  EXPECT_EQ(refusal("axis = []\n"), "loads.toml:2:8: key 'axis': empty, expected tables [[axis]]");
  const std::string width = "[[axis]]\nname = \"a\"\nset = { \"let.width\" = [\"1 mm\"] }\n";
  const std::string height = "[[axis]]\nname = \"a\"\nset = { \"let.height\" = [\"1 mm\"] }\n";
  expect_parts(refusal(width + height), {"found two axes named 'a', expected a name for each"});
  expect_parts(refusal("[[axis]]\nname = \"\"\nset = { \"let.width\" = [\"1 mm\"] }\n"),
               {"axis.name", "expected a name of the axis"});
}

TEST_F(SweepAxes, a_run_without_keys_has_no_charts_over_them) {
  const Study s = study("[[run]]\nname = \"as_it_is\"\n");
  std::vector<RunRecord> runs(1);
  runs[0].punch = "punch";
  fs::create_directories(folder / "as_it_is");
  std::ofstream(folder / "as_it_is" / "history.csv") << "time[s],step\n0,0\n";
  runs[0].status.emplace().add_metric("blanking.largest_force.punch[N/m]", 2e6);
  expect_parts(sweep_report(s, runs, folder, "test"), {"blanking.largest_force.punch"});
}

TEST_F(SweepAxes, what_was_not_measured_leaves_its_cell_empty) {
  const Study s = study("columns = [\"metrics.chip_ratio\", \"metrics.Fc\"]\n[[run]]\nname = \"short\"\n");
  std::vector<RunRecord> runs(1);
  runs[0].status.emplace().add_metric("chip_ratio", std::nan(""));
  runs[0].status->add_metric("Fc[N]", 800.0);
  const std::string page = sweep_report(s, runs, folder, "test");
  EXPECT_EQ(page.find("not a number"), std::string::npos);
  expect_parts(page, {"<td></td>", "<td>800</td>"});
}

TEST_F(SweepAxes, cuts_have_columns_and_charts_of_their_own) {
  const Study s = study("[grid]\n\"let.width\" = [\"1 mm\", \"2 mm\"]\n");
  std::vector<RunRecord> runs(2);
  for (std::size_t k = 0; k < 2; ++k) {
    const double more = 1.0 + static_cast<double>(k);
    runs[k].punch = "punch";
    fs::create_directories(folder / s.runs[k].name);
    std::ofstream(folder / s.runs[k].name / "history.csv") << "time[s],step\n0,0\n";
    results::RunStatus& status = runs[k].status.emplace();
    status.add_metric("peak_force.punch[N/m]", 1.0);
    status.add_metric("blanking.largest_force.punch[N/m]", 2e6 * more);
    status.add_metric("blanking.largest_force.die[N/m]", 2e6);
    status.add_metric("blanking.stroke_at_largest_force.punch[m]", 5e-4 * more);
    status.add_metric("blanking.work.punch[J/m]", 2e3 * more);
    status.add_metric("blanking.slug.rollover[m]", 2e-4 * more);
    status.add_metric("blanking.slug.broken[m]", 1e-4 * static_cast<double>(k));
    status.add_metric("blanking.skeleton.broken[m]", 0.0);
    status.add_metric("blanking.slug.second_burnish[m]", 1e-4);
    status.add_metric("blanking.slug.burr[m]", 1e-5 * more);
    status.add_metric("blanking.skeleton.burr[m]", 2e-5 * more);
  }
  EXPECT_EQ(table_columns(s, runs),
            (std::vector<std::string>{
                "nodes", "steps", "energy_residual", "metrics.blanking.largest_force.punch",
                "metrics.blanking.stroke_at_largest_force.punch", "metrics.blanking.work.punch",
                "metrics.blanking.slug.rollover", "metrics.blanking.slug.broken",
                "metrics.blanking.slug.burr", "metrics.blanking.skeleton.burr"}));
  const std::string page = sweep_report(s, runs, folder, "test");
  expect_parts(page, {"largest force of punch against width", "work of punch against width",
                      "burr of the slug against width", "burr of the skeleton against width", "width [mm]",
                      "<th>blanking.largest_force.punch [N/mm]</th>", "<th>blanking.slug.burr [mm]</th>",
                      "<td>4000</td>"});
  EXPECT_EQ(page.find("peak_force"), std::string::npos);
}

} // namespace
} // namespace cnem::study
