// Measured curves beside computed ones: differences of curves that are known, factors of parts, file and
// page.
#include "evaluate/experiment.hpp"

#include "core/error.hpp"
#include "report/experiment_page.hpp"
#include "report/report_tables.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <fstream>

namespace cnem::evaluate {
namespace {

TEST(Experiment, differences_of_straight_curves_are_exact) {
  const ComparedCurve measured{{0.0, 1.0, 2.0}, {0.0, 2.0, 0.0}}, computed{{0.5, 1.5, 3.0}, {1.0, 3.0, 0.0}};
  const CurveDifference d = compare_curves(measured, computed);
  EXPECT_EQ(d.from, 0.5);
  EXPECT_EQ(d.to, 2.0);
  EXPECT_EQ(d.peak_measured, 2.0);
  EXPECT_EQ(d.peak_computed, 3.0);
  EXPECT_EQ(d.at_computed, 1.5);
  EXPECT_NEAR(d.area_measured, 0.75 + 1.0, 1e-15);
  EXPECT_NEAR(d.area_computed, 2.0 + 0.25 * (3.0 + 2.0), 1e-15);
  // 0 until 1, to 2 at 1.5, still 2 at 2: ∫ (4 (x − 1))² + 4 · 0.5.
  EXPECT_NEAR(d.rms, std::sqrt((16.0 * 0.125 / 3.0 + 2.0) / 1.5), 1e-15);
  EXPECT_FALSE(compare_curves(measured, {{3.0, 4.0}, {1.0, 1.0}}).common());
  EXPECT_EQ(compare_curves(measured, measured).rms, 0.0);
}

/// A punch that goes down at 1 m/s, 1 mm, with a force that grows to 1 MN/m (N).
results::HistoryTable ramp() {
  results::HistoryTable table;
  table.names = {"time[s]",
                 "punch.force_x[N/m]",
                 "punch.force_y[N/m]",
                 "punch.displacement_x[m]",
                 "punch.displacement_y[m]",
                 "punch.work[J/m]",
                 "punch.stroke[m]"};
  table.column.resize(table.names.size());
  for (int k = 0; k <= 1000; ++k) {
    const double s = k / 1000.0;
    const double row[] = {1e-3 * s, 1e5 * s, -1e6 * s, 0.0, -1e-3 * s, 500.0 * s * s, 1e-3 * s};
    for (std::size_t c = 0; c < table.column.size(); ++c) table.column[c].push_back(row[c]);
  }
  return table;
}

input::Case pressed(const std::string& more, bool round = false) {
  return input::read_small((round ? "[analysis]\nkinematics = \"axisymmetric\"\n" : "") +
                           std::string("[tools.punch]\nrectangle = { from = \"-1 5 mm\", to = \"5 8 mm\" }\n"
                                       "velocity = \"0 -1 m/s\"\n[report.experiment]\n"
                                       "stroke = \"0 0.5 1 mm\"\n") +
                           more);
}

double computed_at_half(const input::Case& input, const BlankingResult* blanking = nullptr) {
  const auto results = evaluate_experiments(input, ramp(), blanking);
  const ComparedCurve& curve = results.at(0).computed;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    if (curve.x[k] >= 0.5e-3) return curve.y[k];
  return 0.0;
}

TEST(Experiment, forces_of_the_model_become_those_of_the_part) {
  const std::string in_newtons = "force = \"0 10 20 kN\"\ncut_length = \"50 mm\"\n";
  EXPECT_NEAR(computed_at_half(pressed(in_newtons)), 25e3, 100.0) << "half of 1 MN/m, 50 mm, one cut";
  EXPECT_NEAR(computed_at_half(pressed(in_newtons + "cuts = 2\n")), 12.5e3, 50.0);
  EXPECT_NEAR(computed_at_half(pressed("force_per_length = \"0 1 2 kN/mm\"\ncuts = 2\n")), 250e3, 1e3);
  EXPECT_NEAR(computed_at_half(pressed(in_newtons + "component = \"across\"\n")), 2.5e3, 10.0);
  EXPECT_NEAR(computed_at_half(pressed(in_newtons + "component = \"y\"\n")), 25e3, 100.0);
  EXPECT_NEAR(computed_at_half(pressed("force = \"0 1 2 MN\"\n", true)), 0.5e6, 2e3) << "of the whole body";
  BlankingResult whole;
  whole.punch = "punch";
  whole.direction_y = -1.0;
  whole.faces.resize(4);
  for (std::size_t k = 0; k < 4; ++k) whole.faces[k].cut = k < 2 ? "left" : "right";
  EXPECT_NEAR(computed_at_half(pressed(in_newtons), &whole), 12.5e3, 50.0) << "two cuts carry the force";
}

// Else the stroke would be that of the punch alone.
TEST(Experiment, cuts_along_z_are_cuts) {
  results::HistoryTable history;
  history.names = {"time[s]"};
  for (const char* tool : {"punch", "die"})
    for (const char* column : {"force_x[N]", "force_y[N]", "force_z[N]", "displacement_x[m]",
                               "displacement_y[m]", "displacement_z[m]", "work[J]", "stroke[m]"})
      history.names.push_back(std::string(tool) + "." + column);
  history.column.resize(history.names.size());
  for (int k = 0; k <= 1000; ++k) {
    const double s = k / 1000.0;
    const double row[] = {1e-3 * s, 0, 0, -1e3 * s, 0, 0,        -1e-3 * s, 0.5 * s * s, 1e-3 * s,
                          0.0,      0, 0, 0.0,      0, 1e-3 * s, 0.0,       1e-3 * s};
    for (std::size_t c = 0; c < history.column.size(); ++c) history.column[c].push_back(row[c]);
  }
  BlankingResult cut;
  cut.punch = "punch";
  cut.dies = {"die"};
  cut.direction_z = -1.0;
  const auto results =
      evaluate_experiments(pressed("force = \"0 10 20 kN\"\ncut_length = \"50 mm\"\n"), history, &cut);
  EXPECT_NEAR(results.at(0).computed.x.back(), 2e-3, 1e-6) << "against the die";
}

TEST(Experiment, file_metrics_and_page_tell_the_difference) {
  const testing::TemporaryFolder folder("experiment");
  EXPECT_TRUE(read_experiments(folder.path()).empty());
  const auto results =
      evaluate_experiments(pressed("force = \"0 20 40 kN\"\ncut_length = \"50 mm\"\n"), ramp(), nullptr);
  write_experiments(folder.path(), results);
  const auto back = read_experiments(folder.path());
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(metrics_of(back), metrics_of(results));
  const auto metrics = metrics_of(back);
  const auto value = [&](const std::string& name) {
    for (const auto& [metric, number] : metrics)
      if (metric == "experiment.measured." + name) return number;
    ADD_FAILURE() << name;
    return 0.0;
  };
  EXPECT_NEAR(value("peak_difference"), 0.25, 0.01);
  EXPECT_NEAR(value("work_difference"), 0.25, 0.01);
  EXPECT_NEAR(value("work_computed[J]"), 25.0, 0.1);
  EXPECT_NEAR(value("rms[N]"), 10e3 / std::sqrt(3.0), 60.0);
  EXPECT_NEAR(value("rms_share"), 0.25 / std::sqrt(3.0), 2e-3);
  input::expect_parts(report::render_experiments(back),
                      {"Force of punch, measured and computed", "stroke [mm]", "force [kN]", ">measured<",
                       ">computed<", "40 kN", "% of the peak", "1 mm"});
  EXPECT_EQ(report::render_experiments({}), "");
  input::expect_parts(report::render_experiments(back, results::ShownUnits({"um", "N", "mJ"})),
                      {"stroke [µm]", "force [N]", "5768 N", "2.5·10⁴ mJ", "1000 µm"});
  results::RunStatus status;
  for (const auto& [metric, number] : metrics) status.add_metric(metric, number);
  EXPECT_TRUE(report::result_table(status, {}).rows.empty()) << "they have a section of their own";
  status.add_metric("stability.stable", 1.0);
  status.flags.emplace_back("stability.stable");
  EXPECT_EQ(report::result_table(status, {}).rows.at(0).second, "yes");
  std::ofstream(folder.path() / results::files::experiment) << "{}";
  try {
    read_experiments(folder.path());
    ADD_FAILURE() << "read";
  } catch (const IoError& error) {
    input::expect_parts(error.what(), {"experiment.json is not what an evaluation of a run leaves"});
  }
}

/// Every so many rows of the ramp, and its last one.
results::HistoryTable few_rows(std::size_t every) {
  const results::HistoryTable all = ramp();
  results::HistoryTable few;
  few.names = all.names;
  few.column.resize(all.column.size());
  for (std::size_t c = 0; c < all.column.size(); ++c) {
    for (std::size_t k = 0; k < 1000; k += every) few.column[c].push_back(all.column[c][k]);
    few.column[c].push_back(all.column[c].back());
  }
  return few;
}

TEST(Experiment, few_rows_leave_finite_curves) {
  const testing::TemporaryFolder folder("experiment");
  const input::Case input = pressed("force = \"0 20 40 kN\"\ncut_length = \"50 mm\"\n");
  const auto results = evaluate_experiments(input, few_rows(150), nullptr);
  ASSERT_GE(results.at(0).computed.x.size(), 2U);
  EXPECT_TRUE(std::isfinite(results[0].difference.rms));
  write_experiments(folder.path(), results);
  EXPECT_EQ(metrics_of(read_experiments(folder.path())), metrics_of(results));

  results::HistoryTable nothing = few_rows(150);
  for (double& force : nothing.column[2]) force = std::nan("");
  const auto none = evaluate_experiments(input, nothing, nullptr);
  EXPECT_EQ(none.at(0).note, "The run has no force of punch.");
  write_experiments(folder.path(), none);
  EXPECT_EQ(report::render_experiments(read_experiments(folder.path())).find("not a number"),
            std::string::npos);
}

/// A force that jumps is blunted by the low-pass of computed forces, and by the same where it is measured.
TEST(Experiment, measured_curves_pass_what_computed_ones_do) {
  results::HistoryTable table = ramp();
  input::Case input = pressed("force_per_length = \"0 1 1 kN/mm\"\n");
  std::vector<double>&x = input.report.experiments[0].x, &force = input.report.experiments[0].force;
  x.clear();
  force.clear();
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const double jump = k < 100 ? 1e5 : 1e6 + 5e4 * std::sin(0.05 * static_cast<double>(k));
    table.column[2][k] = -jump;
    if (k < 50 || k > 900) continue; // measured over a part of the stroke
    x.push_back(table.column[6][k]);
    force.push_back(jump);
  }
  const ExperimentResult result = evaluate_experiments(input, table, nullptr).at(0);
  ASSERT_GT(result.passed_measured.x.size(), 100U);
  EXPECT_EQ(result.passed_measured.x, result.passed_computed.x);
  EXPECT_GE(result.passed_measured.x.front(), 50e-6);
  EXPECT_LE(result.passed_measured.x.back(), 900e-6);
  for (std::size_t k = 0; k < result.passed_measured.x.size(); ++k)
    EXPECT_NEAR(result.passed_measured.y[k], result.passed_computed.y[k], 1e-6 * 1e6) << k;
  EXPECT_GT(result.difference.rms, 0.02e6) << "beside what is not low-passed";
}

TEST(Experiment, notes_say_what_cannot_be_compared) {
  const auto note = [](const std::string& points) {
    input::Case input = pressed("force_per_length = \"0 2 1 kN/mm\"\n");
    input.report.experiments[0].x =
        points == "late" ? std::vector{2e-3, 3e-3, 4e-3} : std::vector{0.0, 2e-3, 3e-3};
    return evaluate_experiments(input, ramp(), nullptr).at(0).note;
  };
  input::expect_parts(note("late"), {"no stroke in common", "2 mm", "4 mm"});
  input::expect_parts(note("long"), {"The run ends at", "before the measured peak"});
}

} // namespace
} // namespace cnem::evaluate
