// Forces of known courses and their steady part, the file of a cut and its page, keys of [report.cutting].
#include "evaluate/cutting_forces.hpp"
#include "evaluate/cutting_result.hpp"
#include "evaluate/ply_cut.hpp"
#include "input/cutting_edge.hpp"
#include "input/cutting_tool.hpp"
#include "report/cutting_page.hpp"
#include "report/picture_recorder.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/degree.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <numbers>

namespace cnem::evaluate {
namespace {

constexpr double uncut = 3e-4, speed = 10.0;

/// Sums of forces that are given over the cut in feeds, in steps of a hundredth of one.
template<class Force> CutImpulse impulse_of_force(double feeds, Force&& force) {
  CutImpulse impulse;
  double Fc = 0.0, Ft = 0.0;
  for (int k = 0; k <= static_cast<int>(100 * feeds); ++k) {
    const double cut = 0.01 * k * uncut;
    impulse.cut.push_back(cut);
    impulse.time.push_back(cut / speed);
    impulse.Fc.push_back(Fc);
    impulse.Ft.push_back(Ft);
    const double step = 0.01 * uncut / speed, f = force(0.01 * k + 0.005);
    Fc += step * f;
    Ft -= 0.3 * step * f;
  }
  return impulse;
}

const SteadyRule rule{.feed = uncut, .feeds = 3.0, .tolerance = 0.05, .window = 0.2 * uncut};

TEST(CuttingForces, steady_part_leaves_the_run_in_out) {
  const CutImpulse impulse = impulse_of_force(
      10.0, [](double x) { return 1e5 * (1.0 - std::exp(-2.0 * x) + 0.03 * std::sin(40.0 * x)); });
  const SteadyPart part = steady_part(impulse, rule);
  EXPECT_TRUE(part.steady) << part.note;
  EXPECT_GT(part.from, 0.5 * uncut);
  EXPECT_LT(part.from, 2.5 * uncut);
  EXPECT_NEAR(part.to, 10.0 * uncut, 0.2 * uncut);
  EXPECT_NEAR(part.mean.Fc, 1e5, 1e3);
  EXPECT_NEAR(part.mean.Ft, -0.3e5, 300.0);
  EXPECT_LT(part.spread.Fc, 0.03e5);
}

TEST(CuttingForces, steady_part_leaves_the_entry_out_whatever_its_force) {
  const double way = 2.0; // feeds before the tool meets the workpiece
  const CutImpulse impulse = impulse_of_force(8.0, [&](double x) { return x < way ? 0.0 : 1e5; });
  const SteadyPart part = steady_part(impulse, rule);
  EXPECT_TRUE(part.steady) << part.note;
  EXPECT_NEAR(part.from, (way + 1.0) * uncut, 0.13 * uncut);
  EXPECT_NEAR(part.to, 8.0 * uncut, 1e-12);
}

TEST(CuttingForces, steady_part_ends_where_the_tool_leaves) {
  const CutImpulse impulse = impulse_of_force(10.0, [](double x) { return x < 8.0 ? 1e5 : 1e4; });
  const SteadyPart part = steady_part(impulse, rule);
  EXPECT_TRUE(part.steady);
  EXPECT_NEAR(part.to, 8.0 * uncut, 0.4 * uncut);
  EXPECT_NEAR(part.mean.Fc, 1e5, 2e3);
}

TEST(CuttingForces, end_before_the_workpiece_breaks_out) {
  const CutImpulse impulse = // falls over two feeds, then the tool is in the air for four
      impulse_of_force(14.0, [](double x) { return x < 8.0 ? 1e5 : std::max(0.0, 1e5 * (10.0 - x) / 2.0); });
  SteadyRule exit = rule;
  exit.end = 10.0 * uncut;
  EXPECT_NEAR(steady_part(impulse, exit).to, 7.5 * uncut, 1e-9);
  exit.tolerance = 0.0; // nothing is steady then
  const SteadyPart part = steady_part(impulse, exit);
  EXPECT_FALSE(part.steady);
  EXPECT_NEAR(part.from, 4.5 * uncut, 1e-9);
  EXPECT_NEAR(part.mean.Fc, 1e5, 1.0);
}

TEST(CuttingForces, rising_force_and_short_cut_are_not_steady_and_say_why) {
  const SteadyPart rising =
      steady_part(impulse_of_force(6.0, [](double x) { return 1e4 * (1.0 + x); }), rule);
  EXPECT_FALSE(rising.steady);
  EXPECT_NE(rising.note.find("Fc"), std::string::npos) << rising.note;
  EXPECT_NEAR(rising.mean.Fc, 1e4 * 5.5, 1.0) << "of the last three feeds";
  const SteadyPart brief = steady_part(impulse_of_force(2.0, [](double) { return 1e5; }), rule);
  EXPECT_FALSE(brief.steady);
  EXPECT_EQ(brief.note, "the cut is 2 feeds long, 4 are needed, one of them for the entry");
  EXPECT_NEAR(brief.mean.Fc, 1e5, 1.0);
}

TEST(CuttingForces, of_teeth_are_taken_over_whole_ones) {
  const double pitch = 1.4; // feeds
  const auto force = [&](double x) {
    return 1e5 * (1.0 + 0.3 * std::sin(2.0 * std::numbers::pi * x / pitch));
  };
  SteadyRule of_teeth = rule;
  of_teeth.tooth = pitch * uncut;
  const SteadyPart part = steady_part(impulse_of_force(12.0, force), of_teeth);
  EXPECT_TRUE(part.steady) << part.note;
  EXPECT_NEAR((part.to - part.from) / (3.0 * pitch * uncut), 2.0, 1e-9);
  EXPECT_NEAR(part.mean.Fc, 1e5, 300.0);
}

TEST(CuttingForces, filter_is_a_centred_mean_over_cut) {
  const CutImpulse impulse = impulse_of_force(4.0, [](double x) { return 1e5 * x; });
  const std::vector<CutForce> filtered = filtered_forces(impulse, 0.2 * uncut);
  EXPECT_NEAR(filtered[200].Fc, 2e5, 1.0);
  EXPECT_NEAR(filtered.front().Fc, 0.05e5, 1.0); // of the half that there is
}

CuttingResult example_cut() {
  CuttingResult result;
  result.tool = "cutter";
  result.cut = 1e-3;
  result.feed = uncut;
  result.width = 4e-3;
  result.steady = true;
  result.steady_to = 1e-3;
  result.Fc = 1.4e5;
  result.Ft = -4e4;
  result.Fc_spread = result.Ft_spread = 1e3;
  result.chip_thickness = 4.2e-4;
  result.chip_ratio = 1.4;
  result.shear_angle = 41.0 * degree;
  result.forces.names = {"cut[m]", "Fc[N/m]", "Ft[N/m]", "Fc.filtered[N/m]", "Ft.filtered[N/m]"};
  result.forces.column = {
      {0, 5e-4, 1e-3}, {0, 1e5, 1.4e5}, {0, -4e4, -4e4}, {0, 1e5, 1.4e5}, {0, -4e4, -4e4}};
  result.chip.names = {"distance[m]", "thickness[m]"};
  result.chip.column = {{1e-4, 2e-4}, {4e-4, 4.4e-4}};
  for (auto* table : {&result.rake_face, &result.depth, &result.isotherms}) {
    table->names = {"distance[m]"};
    table->column.resize(1);
  }
  return result;
}

TEST(CuttingFile, comes_back_as_it_was_written) {
  const testing::TemporaryFolder folder("cutting");
  EXPECT_FALSE(read_cutting(folder.path()));
  write_cutting(folder.path(), example_cut());
  std::ofstream(folder.path() / results::files::cutting_course) << "time[s],cut[m]\n0,0\n1,0.001\n";
  const auto back = read_cutting(folder.path());
  ASSERT_TRUE(back);
  const std::string text = results::read_file(folder.path() / results::files::cutting);
  write_cutting(folder.path(), *back);
  EXPECT_EQ(results::read_file(folder.path() / results::files::cutting), text);
  EXPECT_EQ(back->forces.column, example_cut().forces.column);
  EXPECT_EQ(back->course.rows(), 2U);
  EXPECT_TRUE(std::isnan(back->tooth_spacing));
  std::ofstream(folder.path() / results::files::cutting) << "{}";
  EXPECT_THROW(read_cutting(folder.path()), IoError);
}

TEST(CuttingFile, status_has_newtons_degrees_null_and_a_boolean) {
  results::RunStatus status;
  for (const auto& [name, value] : metrics_of(example_cut())) status.add_metric(name, value);
  status.flags = {"cutting.steady"};
  const std::string text = results::status_json(status);
  for (const char* part : {"\"Fc\": 560.0", "\"Ft\": -160.0", "\"shear_angle\": 41.0",
                           "\"tooth_spacing\": null", "\"steady\": true", "\"cutting.shear_angle\": \"deg\""})
    EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in:\n" << text;
  const testing::TemporaryFolder folder("status");
  results::write_status(folder.path(), status);
  EXPECT_EQ(results::status_json(results::read_status(folder.path())), text);
}

TEST(CuttingPage, shows_forces_chip_and_why_a_cut_is_not_steady) {
  CuttingResult result = example_cut();
  const std::string html = report::render_cutting(result);
  for (const char* part :
       {"560 ± 4 N", "41.0°", "Compression ratio", "Forces over the cut", "Thickness along the chip"})
    EXPECT_NE(html.find(part), std::string::npos) << "no '" << part << "' in:\n" << html;
  EXPECT_EQ(html.find("Tooth"), std::string::npos);
  result.rake = -1e-17;
  EXPECT_NE(report::render_cutting(result).find("<td>0.0°</td>"), std::string::npos);
  result.rake = -0.1;
  EXPECT_NE(report::render_cutting(result).find("<td>−5.7°</td>"), std::string::npos);
  result.steady = false;
  result.steady_note = "Fc rises";
  result.residual_note = "tied nodes";
  result.residual_stress_surface = -2.1e8;
  result.depth.names = {"depth[m]", "residual_along[Pa]", "stress_along[Pa]"};
  result.depth.column = {{0.0, 1e-5}, {-2.1e8, -1e8}, {-2e8, -0.9e8}};
  const std::string other = report::render_cutting(result);
  for (const char* part : {"Not steady: Fc rises.", "<p>tied nodes</p>", "−210 MPa", "unloaded and cooled"})
    EXPECT_NE(other.find(part), std::string::npos) << "no '" << part << "' in:\n" << other;
}

TEST(BrokenChip, engaged_while_the_force_is_within_a_tenth_of_its_peak_and_completed_when_half_is_lost) {
  const std::vector<double> cut{0, 1, 2, 3, 4, 5, 6, 7}, force{0, 50, 92, 100, 95, 80, 45, 120},
      whole(cut.size(), 0.0);
  const BrokenChip chip = broken_chip(cut, force, whole);
  EXPECT_EQ(chip.peak, 100.0); // what comes after completion is another chip
  EXPECT_EQ(chip.engaged, 2.0);
  EXPECT_EQ(chip.released, 5.0);
  EXPECT_EQ(chip.completed, 6.0);
  EXPECT_EQ(chip.last, 6u);
}

TEST(BrokenChip, broken_through_is_completed) {
  const std::vector<double> cut{0, 1, 2, 3, 4, 5}, force{0, 50, 92, 100, 97, 96}, parted{0, 0, 0, 0, 1, 1};
  const BrokenChip chip = broken_chip(cut, force, parted);
  EXPECT_EQ(chip.completed, 4.0);
  EXPECT_EQ(chip.released, 4.0);
  const BrokenChip going_on = broken_chip(cut, force, std::vector<double>(cut.size(), 0.0));
  EXPECT_FALSE(std::isfinite(going_on.completed));
  EXPECT_EQ(going_on.peak, 100.0);
  EXPECT_FALSE(std::isfinite(broken_chip({}, {}, {}).peak));
}

/// Square cells of side 1 on a grid of columns by rows from (0, 0) on, and their points.
Approximation<2> squares(int columns, int rows) {
  Approximation<2> made;
  CellGeometry<2>& cells = made.cells;
  cells.begin = {0}, cells.vertex_begin = {0};
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) {
      cells.vertex.emplace_back(x, y);
      cells.vertex_node.push_back(as<NodeIndex>(cells.vertex_node.size()));
      cells.vertex_weight.push_back(1.0);
      cells.vertex_begin.push_back(as<std::int32_t>(cells.vertex_node.size()));
    }
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int low = y * (columns + 1) + x, high = low + columns + 1;
      for (const int v : {low, low + 1, high + 1, high}) cells.index.push_back(v);
      cells.begin.push_back(as<std::int32_t>(cells.index.size()));
    }
  made.mechanics.volume.assign(index_of(columns * rows), 1.0);
  return made;
}

TEST(PlyCut, a_stair_of_broken_cells_leads_to_the_free_surface_along_its_slope) {
  constexpr int side = 16;
  const Approximation<2> block = squares(2 * side, side);
  PointState<2> point;
  point.failing.switch_on(true);
  for (FieldTable* table : {&point.table, &point.failing}) table->rest(block.mechanics.volume.size());
  const auto damage = [&](int x, int y) -> double& {
    return point.matrix_compression_damage[index_of(y * 2 * side + x)];
  };
  for (int y = 0; y < side; ++y) // one up, one along
    for (const int x : {y, y + 1}) damage(x, y) = plasticity::Failure::broken;
  const PlyCut through = look_at_plies(point, block, block.cells.vertex, side, 0.0);
  EXPECT_TRUE(through.parted);
  EXPECT_NEAR(through.plane, std::atan(1.0), 1e-9);
  EXPECT_NEAR(through.matrix_area, 2 * side * plasticity::Failure::broken, 1e-9);
  EXPECT_EQ(through.fibre_area, 0.0);
  EXPECT_EQ(through.matrix_depth, 0.0);
  for (const int x : {8, 9}) damage(x, 8) = 0.9; // a bridge
  const PlyCut bridged = look_at_plies(point, block, block.cells.vertex, side, 0.0);
  EXPECT_FALSE(bridged.parted);
  EXPECT_FALSE(std::isfinite(bridged.plane));
}

const std::string cutter =
    "[tools.cutter]\nstart = \"-3 6 mm\"\npath = [{ to = \"-0.1 4.6 mm\" }, { to = \"-1 8 mm\" }, { "
    "to = \"-3 8 mm\" }]\nvelocity = \"10 0 m/s\"\n";

TEST(CuttingKeys, tool_and_feed_are_found_from_the_tools) {
  EXPECT_FALSE(input::read_small(cutter).report.cutting);
  const input::Case cut = input::read_small(cutter + "[report.cutting]\nwidth = \"4 mm\"\n");
  ASSERT_TRUE(cut.report.cutting);
  EXPECT_NEAR(cut.report.cutting->feed, 0.4e-3, 1e-12);
  EXPECT_NEAR(cut.report.cutting->filter, 0.08e-3, 1e-12);
  EXPECT_EQ(cut.report.cutting->width, 4e-3);
  EXPECT_FALSE(cut.report.cutting->wear);
  const input::CuttingTool tool = input::cutting_tool(cut, 0);
  EXPECT_NEAR(tool.rake, std::atan(0.9 / 3.4), 1e-12);
  EXPECT_NEAR((tool.tip - Vec2(-0.1e-3, 4.6e-3)).norm(), 0.0, 1e-12);
  EXPECT_EQ(tool.away, Vec2(0, 1));
  EXPECT_NEAR(input::cutting_edge(cut, 0).clearance, std::atan(1.4 / 2.9), 1e-12);
  EXPECT_EQ(input::cutting_edge(cut, 0).radius, 0.0);
  const std::string again = input::read_case_text(cut.resolved, "resolved.toml").resolved;
  EXPECT_EQ(again.substr(again.find('\n')), cut.resolved.substr(cut.resolved.find('\n')));
  const input::Case worn = input::read_small(
      cutter + "[report.cutting]\nwear = { a = \"7.8e-9 1/Pa\", b = \"5302 K\" }\nfeed = \"0.3 mm\"\n");
  EXPECT_NEAR(worn.report.cutting->wear->a, 7.8e-9, 1e-20);
  EXPECT_EQ(worn.report.cutting->feed, 0.3e-3);
}

TEST(CuttingKeys, rounded_edges_and_any_direction_have_the_same_tip) {
  // The same tool, turned by half a turn: it moves along −x below the workpiece.
  const input::Case cut =
      input::read_small("[tools.cutter]\nstart = \"13 -1 mm\"\npath = [{ to = \"10.1 0.4 mm\", fillet = "
                        "\"0.05 mm\" }, { to = \"11 "
                        "-3 mm\" }, { to = \"13 -3 mm\" }]\nvelocity = \"-10 0 m/s\"\n[report.cutting]\n");
  const input::CuttingTool tool = input::cutting_tool(cut, 0);
  EXPECT_EQ(tool.away, Vec2(0, -1));
  EXPECT_NEAR(tool.rake, std::atan(0.9 / 3.4), 1e-12);
  EXPECT_LT(cut.report.cutting->feed, 0.4e-3) << "the edge takes some of it";
  EXPECT_GT(cut.report.cutting->feed, 0.35e-3);
  EXPECT_GT(tool.begin, 0.0);
  EXPECT_NEAR(tool.tip.y(), cut.report.cutting->feed, 1e-12);
  EXPECT_NEAR(input::cutting_edge(cut, 0).clearance, std::atan(1.4 / 2.9), 1e-12);
  EXPECT_NEAR(input::cutting_edge(cut, 0).radius, 0.05e-3, 1e-12);
}

TEST(CuttingKeys, a_flank_begins_beyond_edge_and_chamfer) {
  const input::Case cut = input::read_small(
      "[tools.cutter]\nstart = \"-3 5 mm\"\npath = [{ to = \"-0.2 4.6 mm\", fillet = \"0.02 mm\" }, { to = "
      "\"-0.1 4.7 mm\", fillet = \"0.03 mm\" }, { to = \"-0.1 8 mm\" }, { to = \"-3 8 mm\" }]\nvelocity = "
      "\"10 0 "
      "m/s\"\n[report.cutting]\n");
  EXPECT_NEAR(input::cutting_tool(cut, 0).rake, 0.0, 1e-12);
  EXPECT_NEAR(input::cutting_edge(cut, 0).clearance, std::atan(0.4 / 2.8), 1e-12);
  EXPECT_NEAR(input::cutting_edge(cut, 0).radius, 0.03e-3, 1e-12);
}

TEST(CuttingKeys, a_window_follows_a_tool) {
  const input::Case plain = input::read_small(
      cutter + "[output.windows.edge]\nbox = [\"-20 3 mm\", \"-15 7 mm\"]\nfollow = \"cutter\"\n");
  EXPECT_EQ(plain.output.windows.at(0).follow, 0U);
  input::expect_parts(
      input::refusal(cutter + "[output.windows.edge]\nbox = [\"0 3 mm\", \"5 7 mm\"]\nfollow = \"cuter\"\n"),
      {"output.windows.edge.follow", "did you mean 'cutter'"});
  const Curve none;
  const report::PictureWindow moved =
      report::window_at(plain.output.windows[0], {{&none, Vec2(0.001, 0.002), "cutter"}});
  EXPECT_NEAR((moved.low - Vec2(-0.019, 0.005)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((moved.high - Vec2(-0.014, 0.009)).norm(), 0.0, 1e-12);
}

} // namespace
} // namespace cnem::evaluate
