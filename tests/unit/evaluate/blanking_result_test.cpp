// Forces of analytic histories, the file of a cut and its page, and keys of [report].
#include "evaluate/force_stroke.hpp"
#include "report/blanking_page.hpp"
#include "results/output_folder.hpp"
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

namespace cnem::evaluate {
namespace {

namespace fs = std::filesystem;

/// F = 2 MN/m sin(π t/T) on a punch that goes down at 3 m/s, against a die that gives way at 1 m/s; the
/// punch's own work is ∫F ds. Uneven times.
results::HistoryTable sine() {
  constexpr double duration = 1e-3, force = 2e6;
  results::HistoryTable table;
  table.names = {"time[s]",
                 "punch.force_x[N/m]",
                 "punch.force_y[N/m]",
                 "punch.displacement_x[m]",
                 "punch.displacement_y[m]",
                 "punch.work[J/m]",
                 "die.force_x[N/m]",
                 "die.force_y[N/m]",
                 "die.displacement_x[m]",
                 "die.displacement_y[m]",
                 "die.work[J/m]"};
  table.column.resize(table.names.size());
  const int rows = 2000;
  for (int k = 0; k <= rows; ++k) {
    const double s = k / double(rows),
                 t = duration * (s + 0.1 * std::sin(std::numbers::pi * s) / std::numbers::pi);
    const double f = force * std::sin(std::numbers::pi * t / duration),
                 work =
                     force * duration / std::numbers::pi * (1.0 - std::cos(std::numbers::pi * t / duration));
    const double row[] = {t, 0.1 * f, -f, 0.0, -3.0 * t, 3.0 * work, 0.0, f, 0.0, -1.0 * t, -1.0 * work};
    for (std::size_t c = 0; c < table.column.size(); ++c) table.column[c].push_back(row[c]);
  }
  return table;
}

TEST(ForceStroke, largest_force_stroke_and_work_of_a_sine) {
  const ForceCurve curve = force_curve(sine(), "punch", "punch", {"die"}, Vec3(0, -1, 0));
  const ToolForce force = largest_force(curve, "punch");
  // The Gaussian of σ = T/100 takes exp(−(π/100)²/2) of a sine.
  const double passed = std::exp(-0.5 * std::pow(std::numbers::pi / 100.0, 2));
  EXPECT_NEAR(force.largest / (2e6 * passed), 1.0, 1e-5);
  EXPECT_NEAR(force.largest_sample, 2e6, 2.0);
  EXPECT_NEAR(force.stroke, 2.0 * 0.5e-3, 5e-6); // punch against die: 3 − 1 m/s; one in 600 times
  EXPECT_NEAR(force.work, 3.0 * 2e6 * 2e-3 / std::numbers::pi, 1e-6);
  const ToolForce die = largest_force(force_curve(sine(), "die", "punch", {"die"}, Vec3(0, -1, 0)), "die");
  EXPECT_NEAR(die.largest, force.largest, 1e-6 * force.largest);
  EXPECT_NEAR(die.work, -force.work / 3.0, 1e-9);
}

TEST(ForceStroke, one_row_is_enough_and_a_missing_column_is_named) {
  results::HistoryTable table = sine();
  for (auto& column : table.column) column.resize(1);
  EXPECT_EQ(largest_force(force_curve(table, "punch", "punch", {}, Vec3(0, -1, 0)), "punch").largest, 0.0);
  try {
    force_curve(table, "ram", "punch", {}, Vec3(0, -1, 0));
    FAIL();
  } catch (const IoError& error) { EXPECT_STREQ(error.what(), "the history has no column 'ram.force_x'"); }
}

TEST(ForceStroke, the_leading_force_is_that_of_the_tool_that_moves_farthest) {
  results::HistoryTable table = sine();
  EXPECT_EQ(tools_of(table), (std::vector<std::string>{"punch", "die"}));
  EXPECT_FALSE(leading_force(table)->over_stroke) << "nothing says that a tool has a stroke";
  for (const double way : {3.0, 1.0}) {
    table.names.push_back(way > 2.0 ? "punch.stroke[m]" : "die.stroke[m]");
    table.column.push_back(table.column.front());
    for (double& stroke : table.column.back()) stroke *= way;
  }
  EXPECT_EQ(moving_tool(table), "punch");
  const LeadingForce leading = *leading_force(table);
  EXPECT_EQ(leading.of, "punch");
  EXPECT_TRUE(leading.over_stroke);
  EXPECT_NEAR((leading.along - Vec3(0, -1, 0)).norm(), 0.0, 1e-15);
  const ForceCurve curve = force_curve(table, leading);
  EXPECT_NEAR(curve.stroke.back(), 3e-3, 1e-15) << "of the punch alone";
  EXPECT_EQ(curve.even_time.size(), curve.smooth.size());
}

TEST(ForceStroke, where_no_tool_moves_the_largest_impulse_leads_of_tools_then_of_supports) {
  results::HistoryTable table;
  table.names = {"time[s]",           "wall.force_x[N/m]",         "wall.force_y[N/m]",
                 "wall.force_z[N/m]", "support.base.force_x[N/m]", "support.base.force_y[N/m]"};
  table.column = {{0, 1, 2}, {1, 9, -9}, {0, -1, 0}, {0, -5, -8}, {0, 0, 0}, {-8, 0, 9}};
  const LeadingForce wall = *leading_force(table);
  EXPECT_EQ(wall.of, "wall");
  EXPECT_EQ(wall.along, Vec3(0, 0, 1));
  EXPECT_EQ(force_curve(table, wall).force, (std::vector<double>{0, -5, -8}));
  for (std::size_t k = 1; k < 4; ++k) table.column[k] = {0, 0, 0};
  const LeadingForce base = *leading_force(table);
  EXPECT_EQ(base.of, "support.base");
  EXPECT_EQ(base.along, Vec3(0, 1, 0));
  EXPECT_TRUE(std::isnan(force_curve(table, base).work));
  table.column.back() = {0, 0, 0};
  EXPECT_FALSE(leading_force(table));
}

BlankingResult example() {
  BlankingResult result;
  result.punch = "punch";
  result.dies = {"die"};
  result.direction_y = -1.0;
  result.stroke = 2e-3;
  result.time = 1e-3;
  result.forces = {{"punch", 1.9e6, 1e-3, 2e6, 4e3}, {"die", 1.9e6, 1e-3, 2e6, 0.0}};
  result.springback = {{"slug", 3e-6, NAN, NAN, 2e-5, -1e-6}, {"skeleton", 8e-6, 0.01, -0.001, NAN, NAN}};
  ShearedFace face;
  face.body = "slug";
  face.parted = true;
  face.thickness = 1e-3;
  face.rollover = 0.1e-3;
  face.burnish = 0.3e-3;
  face.fracture = 0.6e-3;
  face.burr = 0.05e-3;
  face.broken = 0.02e-3;
  face.burnish -= face.broken;
  face.fracture_angle = 0.1;
  face.profile = {{-1e-3, 0},  {-0.2e-3, 0},     {0, 0.1e-3},         {0, 0.38e-3},
                  {0, 0.4e-3}, {-0.05e-3, 1e-3}, {-0.05e-3, 1.05e-3}, {-1e-3, 1e-3}};
  face.zone = {Zone::surface,  Zone::rollover, Zone::burnish,  Zone::broken,
               Zone::fracture, Zone::burr,     Zone::burr_side};
  result.faces = {face};
  result.cut_length = 2.0;
  return result;
}

class BlankingFile : public ::testing::Test {
protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("cnem_blanking_io_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path folder;
};

TEST_F(BlankingFile, comes_back_as_it_was_written) {
  EXPECT_FALSE(read_blanking(folder));
  write_blanking(folder, example());
  const std::string text = results::read_file(folder / results::files::blanking);
  const auto back = read_blanking(folder);
  ASSERT_TRUE(back);
  write_blanking(folder, *back);
  EXPECT_EQ(results::read_file(folder / results::files::blanking), text);
  EXPECT_EQ(back->faces[0].profile, example().faces[0].profile);
  EXPECT_EQ(back->faces[0].zone, example().faces[0].zone);
  EXPECT_TRUE(std::isnan(back->springback[0].angle_change));
  EXPECT_EQ(back->forces[0].stroke, 1e-3);
  EXPECT_EQ(back->faces[0].broken, 0.02e-3);
  EXPECT_TRUE(back->faces[0].measured);
  EXPECT_EQ(back->cut_length, 2.0);
  EXPECT_EQ(back->dies, example().dies);
}

TEST_F(BlankingFile, measured_heights_stand_beside_the_computed_ones) {
  BlankingResult result = example();
  MeasuredHeights measured{result.faces[0].cut, result.faces[0].body};
  measured.burnish = 0.35e-3;
  result.measured = {measured};
  write_blanking(folder, result);
  const auto back = read_blanking(folder);
  ASSERT_TRUE(back);
  ASSERT_NE(measured_of(*back, back->faces[0]), nullptr);
  double difference = 0.0;
  for (const auto& [name, value] : metrics_of(*back))
    if (name.ends_with(".burnish_difference[m]")) difference = value;
  EXPECT_NEAR(difference, -0.07e-3, 1e-12);
  input::expect_parts(report::render_blanking(*back, std::nullopt),
                      {"0.28 mm  (28.0 %), measured 0.35 mm  (35.0 %)"});
  std::string older = results::read_file(folder / results::files::blanking);
  older.erase(older.find("\"measured\""), older.find("\"springback\"") - older.find("\"measured\""));
  std::ofstream(folder / results::files::blanking) << older;
  EXPECT_TRUE(read_blanking(folder)->measured.empty());
}

TEST_F(BlankingFile, a_foreign_file_is_refused) {
  for (const char* text : {"{}", "no json", R"({"punch": 3})"}) {
    std::ofstream(folder / results::files::blanking) << text;
    EXPECT_THROW(read_blanking(folder), IoError) << text;
  }
}

TEST(BlankingPage, drawing_names_zones_with_their_shares) {
  const std::string svg = report::face_drawing(example().faces[0]);
  for (const char* part : {"Rollover 10.0 %", "Burnish 28.0 %", "Broken, not open 2.0 %", "Fracture 60.0 %",
                           "Burr 5.0 %", "class=\"line fracture\"", "surface on the side of the die"})
    EXPECT_NE(svg.find(part), std::string::npos) << "no '" << part << "' in:\n" << svg;
}

TEST(BlankingPage, marks_the_largest_force_and_shows_tables) {
  const results::HistoryTable table = sine();
  const BlankingResult result = example();
  const auto chart = report::force_stroke_chart(result, table);
  ASSERT_TRUE(chart);
  ASSERT_EQ(chart->series.size(), 6U);
  EXPECT_TRUE(chart->series[2].dashed);
  EXPECT_EQ(chart->series[2].x[1], 1e-3);
  EXPECT_NEAR(chart->series[2].y[1], 2e6, 2e3);
  const std::string html = report::render_blanking(result, chart);
  for (const char* part :
       {"Face of the slug", "0.1 mm  (10.0 %)", "Fracture angle", "5.73°", "Largest force of punch",
        "at a stroke of 1 mm", "Work of punch", "Dishing of slug", "Angle of skeleton"})
    EXPECT_NE(html.find(part), std::string::npos) << "no '" << part << "' in:\n" << html;
  EXPECT_EQ(report::render_blanking({}, {}), "");
}

TEST(BlankingPage, metrics_have_heights_and_shares) {
  const auto metrics = metrics_of(example());
  const auto value = [&](const std::string& name) {
    for (const auto& [known, number] : metrics)
      if (known == name) return number;
    return std::nan("");
  };
  EXPECT_EQ(value("blanking.slug.burnish[m]"), 0.28e-3);
  EXPECT_NEAR(value("blanking.slug.burnish_share"), 0.28, 1e-15);
  EXPECT_EQ(value("blanking.slug.broken[m]"), 0.02e-3);
  EXPECT_EQ(value("blanking.largest_force.punch[N/m]"), 1.9e6);
  EXPECT_EQ(value("blanking.work.punch[J/m]"), 4e3);
  EXPECT_EQ(metrics_of(example().springback).front().second, 8e-6);
}

// In space: a face an angle, means with their spread, heights over the angle.
TEST_F(BlankingFile, round_the_punch_there_are_means_and_spreads) {
  BlankingResult result = example();
  result.direction_y = 0.0;
  result.direction_z = -1.0;
  result.faces.assign(4, result.faces[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    result.faces[k].angle = 0.5 * static_cast<double>(k);
    result.faces[k].burnish = (0.2 + 0.1 * static_cast<double>(k % 2)) * 1e-3;
    result.faces[k].parted = k > 0;
  }
  result.faces[3].measured = false;
  result.faces[3].burnish = 9.0;
  MeasuredHeights measured{result.faces[0].cut, result.faces[0].body};
  measured.burnish = 0.3e-3;
  result.measured = {measured};
  write_blanking(folder, result);
  const auto back = read_blanking(folder);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->faces[2].angle, 1.0);
  EXPECT_EQ(back->direction_z, -1.0);
  std::map<std::string, double> value;
  for (const auto& [name, number] : metrics_of(*back))
    EXPECT_TRUE(value.emplace(name, number).second) << name;
  const double mean = 0.7e-3 / 3.0;
  EXPECT_EQ(value.at("blanking.slug.parted"), 0.75);
  EXPECT_NEAR(value.at("blanking.slug.burnish[m]"), mean, 1e-15);
  EXPECT_NEAR(value.at("blanking.slug.burnish_share"), mean / 1e-3, 1e-12);
  EXPECT_NEAR(value.at("blanking.slug.burnish_spread[m]"), 0.1e-3 * std::sqrt(2.0) / 3.0, 1e-15);
  EXPECT_EQ(value.at("blanking.slug.rollover_spread[m]"), 0.0);
  EXPECT_NEAR(value.at("blanking.slug.burnish_difference[m]"), mean - 0.3e-3, 1e-15);
  const auto charts = report::round_charts(*back);
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_EQ(charts[0].series[2].label, "Burnish");
  EXPECT_NEAR(charts[0].series[2].x[1], 0.5 / std::numbers::pi * 180.0, 1e-9);
  EXPECT_TRUE(std::isnan(charts[0].series[2].y[3]));
  input::expect_parts(
      report::render_blanking(*back, std::nullopt),
      {"Face of the slug at 0.0°", "Heights of the slug round the punch", "Burnish 0.233 mm ± 0.047 mm"});
  EXPECT_TRUE(report::round_charts(example()).empty());
}

TEST(BlankingPage, a_face_that_cannot_be_measured_has_words_and_no_numbers) {
  BlankingResult result = example();
  ShearedFace& face = result.faces[0];
  face = {};
  face.body = "slug";
  face.measured = false;
  face.note = "cannot be measured: its burr would be 1.2 thicknesses";
  for (const auto& [name, value] : metrics_of(result))
    EXPECT_TRUE(!name.starts_with("blanking.slug") || name == "blanking.slug.parted") << name;
  const std::string html = report::render_blanking(result, {});
  EXPECT_NE(html.find(face.note), std::string::npos);
  EXPECT_EQ(html.find("Fracture"), std::string::npos);
}

const std::string tools =
    "[tools.ram]\nrectangle = { from = \"-1 5 mm\", to = \"5 7 mm\" }\nvelocity = \"0 -1 m/s\"\n"
    "[tools.die]\nrectangle = { from = \"5.1 -2 mm\", to = \"12 0 mm\" }\n"
    "[tools.holder]\nrectangle = { from = \"5.1 5 mm\", to = \"12 7 mm\" }\n";

TEST(ReportKeys, tools_that_cut_are_found_by_name_and_motion) {
  const input::Case plain = input::read_small(tools);
  EXPECT_FALSE(plain.report.blanking);
  EXPECT_FALSE(plain.report.springback);
  const input::Case cut = input::read_small(tools + "[report.blanking]\n");
  ASSERT_TRUE(cut.report.blanking);
  EXPECT_TRUE(cut.report.springback);
  EXPECT_EQ(cut.tools[cut.report.blanking->punch].name, "ram");
  EXPECT_EQ(cut.report.blanking->dies, std::vector<std::size_t>{1});
  EXPECT_NEAR(cut.report.blanking->parallel, 10.0 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_FALSE(cut.report.blanking->smoothing);
  const input::Case named = input::read_small(
      tools + "[report]\nspringback = false\n[report.blanking]\npunch = \"die\"\ndie = [\"ram\", "
              "\"holder\"]\nsmoothing = \"0.1 mm\"\nparallel = \"5 deg\"\n");
  EXPECT_EQ(named.report.blanking->punch, 1U);
  EXPECT_EQ(named.report.blanking->dies, (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(named.report.blanking->smoothing, 1e-4);
  EXPECT_FALSE(named.report.springback);
  // What was found stands in the resolved case, below its first line.
  const std::string again = input::read_case_text(cut.resolved, "resolved.toml").resolved;
  EXPECT_EQ(again.substr(again.find('\n')), cut.resolved.substr(cut.resolved.find('\n')));
}

} // namespace
} // namespace cnem::evaluate
