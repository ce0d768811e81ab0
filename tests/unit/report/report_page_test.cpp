// What a page says: the first numbers of each kind of run, its heading, curves worth a look, units.
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "report/blanking_page.hpp"
#include "report/html.hpp"
#include "report/report.hpp"
#include "results/output_folder.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::report {
namespace {

using evaluate::BlankingResult;
using evaluate::ShearedFace;
using results::ShownUnits;

TEST(Html, numbers_stay_with_their_units) {
  EXPECT_EQ(keep_units("<p>1 mm</p><td>0.1 mm  (10.0 %), at 2 µs, 16 023</td><dd class=\"of\">3 N</dd> 4 m"),
            "<p>1 mm</p><td>0.1\u00a0mm  (10.0\u00a0%), at 2\u00a0µs, 16 023</td><dd "
            "class=\"of\">3\u00a0N</dd> 4 m");
}

const Figure& figure(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& one : figures)
    if (one.name == name) return one;
  ADD_FAILURE() << "no figure " << name;
  static const Figure none;
  return none;
}

std::vector<Figure> of(const results::RunStatus& status, const results::HistoryTable* history = nullptr,
                       const BlankingResult* blanking = nullptr,
                       const evaluate::CuttingResult* cutting = nullptr, const ShownUnits& units = {}) {
  return headline({status, history, blanking, cutting, units});
}

BlankingResult cut_sheet() {
  BlankingResult result;
  result.punch = "punch";
  result.cut_length = 2.0;
  result.forces = {{"die", 3e6, 5e-4, 3e6, 0.0}, {"punch", 3e6, 5e-4, 3.2e6, 2.4e3}};
  ShearedFace face;
  face.parted = true;
  face.thickness = 2e-3;
  face.rollover = 0.3e-3;
  face.burnish = 0.6e-3;
  face.fracture = 1.1e-3;
  face.burr = 1e-5;
  result.faces = {face, face};
  result.faces[0].body = "slug";
  result.faces[1].body = "skeleton";
  result.faces[1].burnish = 0.64e-3;
  result.faces[1].fracture = 1.06e-3;
  return result;
}

TEST(Headline, of_a_cut_is_force_stroke_work_and_the_face) {
  const BlankingResult result = cut_sheet();
  const auto figures = of({}, nullptr, &result);
  ASSERT_GE(figures.size(), 7U);
  EXPECT_EQ(figures[0].name, "Largest force of punch");
  EXPECT_EQ(figures[0].value, "1500 N/mm");
  EXPECT_EQ(figures[0].note, "of cut length; 3000 N/mm of depth, 2 cuts");
  EXPECT_EQ(figures[1].value, "0.5 mm");
  EXPECT_EQ(figures[1].note, "25 % of the thickness");
  EXPECT_EQ(figures[2].value, "1.2 J/mm");
  EXPECT_EQ(figure(figures, "Rollover").value, "15 %");
  EXPECT_EQ(figure(figures, "Burnish").value, "30–32 %");
  EXPECT_EQ(figure(figures, "Fracture").value, "53–55 %");
  EXPECT_EQ(figure(figures, "Burr").value, "0.01 mm");
}

TEST(Headline, of_a_round_blank_is_in_newtons) {
  BlankingResult result = cut_sheet();
  result.force_unit = "N";
  result.work_unit = "J";
  result.cut_length = 0.03;
  result.forces[1].largest = 14.6e3;
  result.forces[1].work = 6.0;
  result.faces[0].parted = false;
  const auto figures = of({}, nullptr, &result);
  EXPECT_EQ(figures[0].value, "14.6 kN");
  EXPECT_EQ(figures[0].note, "486.7 N/mm of cut length");
  EXPECT_EQ(figure(figures, "Work of punch").value, "6 J");
  EXPECT_EQ(figure(figures, "Cut through").value, "no");
}

// Four sections: the slug's burnish scatters round the punch, the skeleton's does not.
TEST(Headline, of_a_cut_in_space_has_means_round_the_punch) {
  BlankingResult result = cut_sheet();
  result.force_unit = "N";
  result.direction_x = 1.0;
  const std::vector<ShearedFace> both = result.faces;
  result.faces.clear();
  for (int k = 0; k < 4; ++k)
    for (ShearedFace face : both) {
      face.angle = (45.0 * k + 22.5) / 180.0 * std::numbers::pi;
      if (face.body == "slug") face.burnish += (k % 2 ? 1.0 : -1.0) * 0.2e-3;
      face.parted = k > 0;
      result.faces.push_back(face);
    }
  const auto figures = of({}, nullptr, &result);
  EXPECT_EQ(figure(figures, "Burnish").value, "30–32 %") << "not 20–40 %";
  EXPECT_EQ(figure(figures, "Burnish").note, "of the thickness, 2 faces, means round the punch");
  EXPECT_EQ(figure(figures, "Cut through").value, "at 3 of 4 angles");
  const std::string page = render_blanking(result, std::nullopt);
  EXPECT_NE(page.find("Face of the slug at 22.5°"), std::string::npos);
  EXPECT_NE(page.find("Angles count from y, counter-clockwise"), std::string::npos) << "the cut is along x";
}

TEST(Headline, of_a_machined_surface_is_forces_chip_and_temperature) {
  evaluate::CuttingResult result;
  result.steady = true;
  result.width = 1e-3;
  result.Fc = 8e5;
  result.Ft = 3e5;
  result.chip_thickness = 0.6e-3;
  result.chip_ratio = 2.0;
  result.temperature_max = 873.15;
  const auto figures = of({}, nullptr, nullptr, &result, ShownUnits({"degC"}));
  EXPECT_EQ(figures[0].value, "800 N");
  EXPECT_EQ(figures[0].note, "1 mm of width");
  EXPECT_EQ(figure(figures, "Chip thickness").note, "2 times the feed");
  EXPECT_EQ(figure(figures, "Largest temperature").value, "600 °C");
}

TEST(Headline, of_a_cracked_body_is_its_stress_intensities) {
  results::RunStatus status;
  status.add_metric("largest_displacement[m]", 2e-5);
  status.add_metric("K_I.right_end[Pa m^0.5]", 3.21e7);
  status.add_metric("K_II.right_end[Pa m^0.5]", 4e5);
  const auto figures = of(status);
  EXPECT_EQ(figures[0].name, "K_I of right end");
  EXPECT_EQ(figures[0].value, "32.1 MPa √m");
  EXPECT_EQ(figures[1].value, "0.4 MPa √m");
  EXPECT_EQ(figure(figures, "Largest displacement").value, "0.02 mm");
}

TEST(Headline, of_others_is_what_became_of_them) {
  results::RunStatus status;
  for (const auto& [name, value] : {std::pair{"extent.x[m]", 7.2e-3},
                                    {"initial_extent.x[m]", 7.2e-3},
                                    {"extent.y[m]", 21.45e-3},
                                    {"initial_extent.y[m]", 32.4e-3}})
    status.add_metric(name, value);
  results::HistoryTable history;
  history.names = {
      "time[s]",   "wall.force_x[N]", "wall.force_y[N]", "max.temperature[K]", "max.plastic_strain",
      "max.damage"};
  history.column = {{0, 1e-5, 2e-5}, {0, 0, 0}, {0, 2e4, 2e4}, {293.15, 500, 480}, {0, 2, 3}, {0, 0, 0}};
  const auto figures = of(status, &history);
  EXPECT_EQ(figures[0].name, "Length along y");
  EXPECT_EQ(figures[0].value, "21.45 mm");
  EXPECT_EQ(figures[0].note, "was 32.4 mm");
  EXPECT_TRUE(figure(figures, "Largest force of wall").value.ends_with(" kN"));
  EXPECT_EQ(figure(figures, "Largest plastic strain").value, "3");
  EXPECT_EQ(figure(figures, "Largest temperature").value, "500 K");
  for (const Figure& one : figures) EXPECT_NE(one.name, "Largest damage") << "nothing is damaged";
  history.column[3] = {293.15, 293.15, 293.15};
  for (const Figure& one : of(status, &history))
    EXPECT_NE(one.name, "Largest temperature") << "nothing is heated";
}

results::HistoryTable energies() {
  results::HistoryTable history;
  history.names = {"time[s]",
                   "energy.plastic[J/m]",
                   "energy.kinetic[J/m]",
                   "energy.hourglass[J/m]",
                   "energy.viscous[J/m]",
                   "energy.initial[J/m]",
                   "energy.nothing[J/m]",
                   "energy.residual[J/m]",
                   "mass[kg/m]",
                   "area[m^2]",
                   "max.damage"};
  history.column = {{0, 1, 2}, {0, 500, 1000}, {0, 50, 20}, {0, 4, -6}, {0, 1, 2}, {7, 7, 7},
                    {0, 0, 0}, {0, 0, 0},      {5, 5, 5},   {1, 1, 1},  {0, 0, 0}};
  return history;
}

TEST(HistoryCharts, what_never_changes_is_not_drawn_and_small_energies_are_one_curve) {
  const std::vector<Chart> charts = history_charts(energies());
  ASSERT_EQ(charts.size(), 1U) << charts.back().title;
  ASSERT_EQ(charts[0].series.size(), 3U);
  EXPECT_EQ(charts[0].series[0].label, "plastic");
  EXPECT_EQ(charts[0].series[1].label, "kinetic");
  EXPECT_EQ(charts[0].series[2].label, "others");
  EXPECT_EQ(charts[0].series[2].y, (std::vector<double>{0, 5, 8}));
  EXPECT_NE(charts[0].note.find("hourglass, viscous"), std::string::npos) << charts[0].note;
}

TEST(HistoryCharts, curves_of_rounding_are_not_drawn) {
  results::HistoryTable history;
  history.names = {"time[s]", "energy.heat_content[J/m]", "energy.plastic[J/m]", "max.temperature[K]"};
  history.column = {{0, 1, 2}, {0, 2e-14, -4e-14}, {0, 0, 0}, {1000, 1000, 999.9999}};
  EXPECT_TRUE(history_charts(history).empty()) << "heat that nothing pays for, a step of 1e-7";
  history.column[2] = {0, 1, 2};
  history.column[3] = {1000, 1000, 999};
  EXPECT_EQ(history_charts(history).size(), 2U);
}

TEST(EnergyTable, has_every_term) {
  const ReportTable table = energy_table(energies(), ShownUnits());
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(table.rows[0].second, "1 J/mm");
  EXPECT_EQ(table.rows[1].second, "20 mJ/mm  (at most 50 mJ/mm)");
  EXPECT_EQ(table.rows.back().second, "nothing, residual");
  EXPECT_TRUE(energy_table({}, ShownUnits()).rows.empty());
}

TEST(Chart, curves_beyond_the_palette_are_dashed_and_axes_have_the_unit_chosen) {
  Chart chart;
  chart.y_label = "temperature";
  chart.y_unit = "K";
  chart.series = {{.label = "a", .x = {0, 1}, .y = {373.15, 473.15}, .colour = 1},
                  {.label = "b", .x = {0, 1}, .y = {373.15, 463.15}, .colour = 9}};
  const std::string svg = svg_chart(chart, ShownUnits({"degC"}));
  EXPECT_NE(svg.find("temperature [°C]"), std::string::npos);
  EXPECT_NE(svg.find(">100</text>"), std::string::npos) << svg;
  EXPECT_NE(svg.find("\"line s1\""), std::string::npos);
  EXPECT_NE(svg.find("\"line s1 dashed\""), std::string::npos);
}

TEST(ShownUnits, are_those_of_the_trade_by_size) {
  const auto shown = [](double value, const char* unit) { return results::si_format(value, unit); };
  EXPECT_EQ(shown(2.99e6, "N/m"), "2990 N/mm");
  EXPECT_EQ(shown(2.99e7, "N/m"), "29.9 kN/mm");
  EXPECT_EQ(shown(2.42e3, "J/m"), "2.42 J/mm");
  EXPECT_EQ(shown(14.6e3, "N"), "14.6 kN");
  EXPECT_EQ(shown(800.0 * 3.14159265358979 / 3.0, "rad/s"), "8000 rpm");
  EXPECT_EQ(shown(5e-7, "m^3/s"), "30 cm³/min");
  EXPECT_EQ(shown(0.3e-3, "m"), "0.3 mm");
  EXPECT_EQ(shown(4e-6, "m"), "4 µm");
  EXPECT_EQ(shown(0.0, "m"), "0 mm");
  EXPECT_EQ(shown(1.031e9, "Pa"), "1031 MPa");
  EXPECT_EQ(shown(210e9, "Pa"), "210 GPa");
  EXPECT_EQ(shown(2.5e9, "J/m^3"), "2.5 J/mm³");
  EXPECT_EQ(shown(1.25e-5, "s"), "12.5 µs");
  EXPECT_EQ(shown(std::acos(-1.0) / 6.0, "rad"), "30°");
  EXPECT_EQ(shown(7850.0, "kg/m^3"), "7850 kg/m³");
  EXPECT_EQ(shown(296.0, "K"), "296 K");
}

TEST(ShownUnits, of_a_case_go_before_and_energies_are_no_forces) {
  const ShownUnits units({"degC", "kN/mm", "J/mm", "um", "GPa"});
  EXPECT_EQ(units.format(296.15, "K"), "23 °C");
  EXPECT_EQ(units.format(2.99e6, "N/m"), "2.99 kN/mm");
  EXPECT_EQ(units.format(50.0, "J/m"), "0.05 J/mm");
  EXPECT_EQ(units.format(14.6e3, "N"), "14.6 kN") << "of the dimension of J/mm";
  EXPECT_EQ(units.format(0.3e-3, "m"), "300 µm");
  EXPECT_EQ(units.format(5e8, "Pa"), "0.5 GPa");
  EXPECT_EQ(units.format(1.0, ""), "1");
  EXPECT_THROW(ShownUnits({"furlong"}), InputError);
}

TEST(ReportPage, heading_is_the_title_and_everything_has_the_units_of_the_case) {
  const cnem::testing::TemporaryFolder folder("page");
  const input::Case known =
      input::read_case_text("title = \"A block & its base\"\n" + cnem::testing::steel_block +
                                "[time]\nend = \"1 us\"\n[report]\nunits = \"degC\"\n",
                            "block.toml");
  EXPECT_EQ(known.report.units, std::vector<std::string>{"degC"});
  std::ofstream(folder.path() / results::files::resolved_case) << known.resolved;
  std::ofstream(folder.path() / results::files::history)
      << "time[s],step,max.temperature[K]\n0,0,293.15\n1e-6,10,393.15\n";
  results::RunStatus status;
  status.case_name = "block";
  status.energy_residual = 2e-5;
  status.nodes = 12345;
  status.add_metric("max_temperature[K]", 393.15);
  const std::string html = render_report(collect_report(folder.path(), status));
  for (const char* part :
       {"<title>A block &amp; its base</title>", "<h1>A block &amp; its base</h1>", " · block</p>",
        "energy residual 0.002 %", "<dt>Largest temperature</dt><dd>120\u00a0°C</dd>", "temperature [°C]",
        "<td>120\u00a0°C</td>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

} // namespace
} // namespace cnem::report
