// Laminates of a study: which run cuts which ply, and what the plies come to together.
#include "study/laminate.hpp"

#include "core/error.hpp"
#include "evaluate/cutting_result.hpp"
#include "input/case_reader.hpp"
#include "results/output_folder.hpp"
#include "study/sweep.hpp"
#include "tests/degree.hpp"
#include "tests/temporary_folder.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* gfrp = "case = \"" CNEM_SOURCE_DIR "/cases/composites/gfrp\"\n";

/// A sweep over the angle with two criteria at 30 deg, whose runs are made here.
class Laminates : public ::testing::Test {
protected:
  void read(const std::string& plies, const std::string& more = "") {
    study = read_study_text(std::string(gfrp) + R"toml(
[[run]]
name = "down"
set = { "let.theta" = "-60 deg", "materials.gfrp.failure.law" = "hashin" }
[[run]]
name = "up"
set = { "let.theta" = "30 deg", "materials.gfrp.failure.law" = "hashin" }
[[run]]
name = "larc"
set = { "let.theta" = "30 deg", "materials.gfrp.failure.law" = "larc02" }
[laminate]
angle = "let.theta"
plies = [)toml" + plies + "]\n" +
                                more,
                            temporary.path() / "stack.toml");
    for (const double angle : {-60.0, 30.0, 30.0}) {
      RunRecord& record = runs.emplace_back();
      record.state = RunRecord::State::done;
      record.variables = {{"theta", angle * degree, "rad", ""}};
    }
  }
  std::string refusal(const std::string& plies, bool cut = true) {
    runs.clear();
    try {
      read(plies);
      runs_of_plies(study, runs, cut ? cuts : std::vector<std::optional<CutConditions>>(3));
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  /// Forces that rise linearly to their peaks (N/mm at µm of cut) and are gone a micrometre later.
  void leave(std::size_t run, double peak, double at, double fibres, double matrix, double end = 20.0) {
    evaluate::CuttingResult cut;
    cut.breaks = breaks;
    cut.Fc = 0.9e3 * peak, cut.Ft = 0.1e3 * peak, cut.Fc_peak = 1e3 * peak;
    if (breaks) cut.completed_at = 1e-6 * (at + 1.0);
    cut.fibre_depth = fibres, cut.matrix_depth = matrix;
    cut.forces.names = {"cut[m]", "Fc[N/m]", "Ft[N/m]", "Fc.filtered[N/m]", "Ft.filtered[N/m]"};
    const std::vector<double> none(4, 0.0);
    cut.forces.column = {
        {0.0, 1e-6 * at, 1e-6 * (at + 1.0), 1e-6 * end}, none, none, {0.0, 1e3 * peak, 0.0, 0.0}, none};
    evaluate::write_cutting(temporary.path() / study.runs[run].name, cut);
    results::write_atomically(temporary.path() / study.runs[run].name / results::files::cutting_course,
                              "cut[m]\n");
    runs[run].status.emplace();
    runs[run].status->metrics = {{"cutting.specific_energy", 1e6 * peak}};
    runs[run].status->metric_units = {{"cutting.specific_energy", "J/m^3"}};
  }

  const cnem::testing::TemporaryFolder temporary{"laminate"};
  Study study;
  bool breaks = true; ///< a chip breaks off the plies of runs that are left
  std::vector<RunRecord> runs;
  std::vector<std::optional<CutConditions>> cuts = std::vector<std::optional<CutConditions>>(
      3, CutConditions{.feed = 0.25e-3, .speed = 1.0, .friction = "none"});
};

constexpr const char* two = R"toml({ name = "top", angle = "-60 deg", thickness = "1 mm" },
{ angle = "210 deg", thickness = "3 mm", set = { "materials.gfrp.failure.law" = "larc02" } })toml";

TEST_F(Laminates, a_ply_is_cut_in_the_run_of_its_angle_whatever_the_half_turns) {
  read(two);
  EXPECT_EQ(study.laminate->plies[0].name, "top");
  EXPECT_EQ(study.laminate->plies[1].name, "2");
  EXPECT_EQ(runs_of_plies(study, runs, cuts), (std::vector<std::size_t>{0, 2}));
}

TEST_F(Laminates, what_is_no_laminate_is_refused_at_its_place) {
  const auto expect = [](const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << "\nin " << message;
  };
  expect(refusal("{ angle = \"45 deg\", thickness = \"1 mm\" }"),
         {"stack.toml:14:10", "laminate.plies", "the angle 45 deg", "-60 deg, 30 deg"});
  expect(refusal("{ angle = \"30 deg\", thickness = \"1 mm\" }"),
         {"2 runs have this angle, 'up' and 'larc'", "'set'"});
  expect(refusal("{ angle = \"-60 deg\", thickness = \"0 mm\" }"),
         {"laminate.plies.thickness", "a length > 0"});
  expect(refusal("{ angle = \"-60 deg\", thickness = \"-1 mm\" }"),
         {"laminate.plies.thickness", "a length > 0"});
  expect(refusal("{ angle = \"-60 deg\", thickness = \"1 deg\" }"), {"laminate.plies.thickness", "length"});
  expect(refusal("{ thickness = \"1 mm\" }"), {"laminate.plies.angle", "missing"});
  expect(refusal(""), {"laminate.plies", "empty"});
  expect(refusal("3"), {"laminate.plies", "tables with angle and thickness"});
  expect(refusal("{ angle = \"30 deg\", thickness = \"1 mm\", set = { \"let.speed\" = \"1 m/s\" } }"),
         {"laminate.plies.set.let.speed", "do not differ"});
  expect(refusal("{ angle = \"30 deg\", thickness = \"1 mm\", set = { \"materials.gfrp.failure.law\" = "
                 "\"larc03\" } }"),
         {"laminate.plies.set.materials.gfrp.failure.law", "larc03",
          "that a run of the study has: \"hashin\", \"larc02\""});
  expect(refusal("{ angle = \"-60 deg\", thickness = \"1 mm\" }", false), {"run 'down'", "[report.cutting]"});
}

TEST_F(Laminates, plies_are_cut_by_one_tool) {
  const auto refused = [&](auto CutConditions::*what, const auto& value) {
    cuts[2] = cuts[0];
    (*cuts[2]).*what = value;
    return refusal(two);
  };
  const std::string start = "key 'laminate.plies': found plies 'top' and '2' cut with ",
                    runs_there = " (runs 'down' and 'larc'), expected one tool";
  for (const auto& [message, values] :
       {std::pair{refused(&CutConditions::rake, 10.0 * degree), "a rake of 0 deg and 10 deg"},
        {refused(&CutConditions::feed, 0.3e-3), "a feed of 0.25 mm and 0.3 mm"},
        {refused(&CutConditions::speed, 2.0), "a speed of 1 m/s and 2 m/s"},
        {refused(&CutConditions::clearance, 7.0 * degree), "a clearance of 0 deg and 7 deg"},
        {refused(&CutConditions::edge_radius, 5e-6), "a radius of the edge of 0 mm and 5 µm"},
        {refused(&CutConditions::friction, "other"), "a friction of none and other"}})
    EXPECT_NE(message.find(start + values + runs_there), std::string::npos) << message;
  EXPECT_EQ(refused(&CutConditions::feed, 0.25e-3 * (1.0 + 1e-14)), "accepted");
}

TEST_F(Laminates, the_tool_is_what_the_case_of_a_run_says) {
  const std::string name = CNEM_SOURCE_DIR "/cases/composites/gfrp/case.toml";
  const auto of = [&](const std::vector<std::string>& changes) {
    std::vector<input::Override> list;
    for (const std::string& change : changes) list.push_back(input::parse_override(change, "--set"));
    return cut_conditions(input::read_case_with(name, list)).value();
  };
  const CutConditions cut = of({}), other = of({"let.speed=2 m/s", "let.depth=0.2 mm"});
  EXPECT_NEAR(cut.rake, 0.0, 1e-12);
  EXPECT_NEAR(cut.feed, 0.25e-3, 1e-12);
  EXPECT_NEAR(cut.speed, 1.0, 1e-12);
  EXPECT_NEAR(cut.clearance, 7.0 * degree, 1e-12);
  EXPECT_NEAR(cut.edge_radius, 5e-6, 1e-12);
  EXPECT_NEAR(other.feed, 0.2e-3, 1e-12);
  EXPECT_NEAR(other.speed, 2.0, 1e-12);
  EXPECT_EQ(other.friction, cut.friction);
  const CutConditions blunt = of({"let.clearance=10 deg", "let.edge=8 um"});
  EXPECT_NEAR(blunt.clearance, 10.0 * degree, 1e-12);
  EXPECT_NEAR(blunt.edge_radius, 8e-6, 1e-12);
  for (const char* change : {"let.friction=0.2", "tools.cutter.friction.by_material.gfrp.coefficient=0.2",
                             "tools.cutter.friction.shear_limit=100 MPa"})
    EXPECT_NE(of({change}).friction, cut.friction) << change;
  EXPECT_NEAR(of({"time.end=25 us"}).speed, 1.0, 1e-12); // its mean is less: the ramp takes 10 us
  EXPECT_FALSE(cut_conditions(
      input::read_case_with(CNEM_SOURCE_DIR "/cases/verification/taylor_copper/case.toml", {})));
}

TEST_F(Laminates, values_are_told_apart_by_what_they_say) {
  const auto same = [](const std::string& a, const std::string& b) {
    return same_value(input::parse_override("k=" + a, "--set").value,
                      input::parse_override("k=" + b, "--set").value);
  };
  EXPECT_TRUE(same("\"10 um\"", "\"0.01 mm\""));
  EXPECT_TRUE(same("1", "1.0"));
  EXPECT_TRUE(same("\"180 deg\"", "\"3.141592653589793 rad\""));
  EXPECT_TRUE(same("[1, \"2 mm\"]", "[1.0, \"2e-3 m\"]"));
  EXPECT_TRUE(same("\"hashin\"", "\"hashin\""));
  EXPECT_FALSE(same("\"10 um\"", "\"0.011 mm\""));
  EXPECT_FALSE(same("\"1 mm\"", "1e-3"));
  EXPECT_FALSE(same("\"1 mm\"", "\"1 ms\""));
  EXPECT_FALSE(same("[1, 2]", "[1, 2, 3]"));
  EXPECT_FALSE(same("\"hashin\"", "\"larc02\""));
  EXPECT_FALSE(same("true", "1"));
}

/// Plies choose their runs by such values too.
TEST_F(Laminates, a_ply_has_the_run_with_its_quantity_in_other_units) {
  const auto stack = [&](const std::string& value) {
    study = read_study_text(std::string(gfrp) + R"toml(
[grid]
"let.edge" = ["5 um", "0.01 mm"]
"let.friction" = [0.3, 1]
[laminate]
angle = "let.theta"
plies = [ { angle = "45 deg", thickness = "1 mm", set = { "let.edge" = )toml" +
                                value + ", \"let.friction\" = 1.0 } } ]\n",
                            temporary.path() / "stack.toml");
    runs.clear();
    for (std::size_t k = 0; k < 4; ++k) runs.emplace_back().variables = {{"theta", 45 * degree, "rad", ""}};
    return runs_of_plies(study, runs, std::vector<std::optional<CutConditions>>(4, cuts[0]));
  };
  EXPECT_EQ(stack("\"10 um\""), (std::vector<std::size_t>{3}));
  EXPECT_EQ(stack("\"0.005 mm\""), (std::vector<std::size_t>{1}));
  try {
    stack("\"20 um\"");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("key 'laminate.plies.set.let.edge': found \"20 um\", expected a value that a run of "
                        "the study has: \"5 um\", \"0.01 mm\""),
              std::string::npos)
        << error.what();
  }
}

TEST_F(Laminates, an_angle_that_is_none_is_refused) {
  read(two);
  study.laminate->angle = "let.speed";
  EXPECT_THROW(runs_of_plies(study, runs, cuts), InputError);
  study.laminate->angle = "materials.gfrp.failure.law";
  EXPECT_THROW(runs_of_plies(study, runs, cuts), InputError);
}

TEST_F(Laminates, plies_count_by_their_thickness) {
  read(two, "columns = [\"metrics.cutting.specific_energy\"]\n");
  const std::vector<std::size_t> run = runs_of_plies(study, runs, cuts);
  leave(0, 40.0, 4.0, 10e-6, 30e-6);
  leave(2, 20.0, 8.0, 45e-6, 5e-6);
  const LaminateCut cut = cut_of_laminate(study, runs, run, temporary.path());
  EXPECT_DOUBLE_EQ(cut.thickness, 4e-3);
  EXPECT_NEAR(cut.Fc[0], 36.0, 1e-12); // 36 N/mm on 1 mm
  EXPECT_NEAR(cut.Fc[1], 54.0, 1e-12); // 18 N/mm on 3 mm
  EXPECT_NEAR(cut.Fc_sum, 90.0, 1e-12);
  EXPECT_NEAR(cut.Ft_sum, 10.0, 1e-12);
  EXPECT_NEAR(cut.columns.at(0).mean, 0.25 * 40e6 + 0.75 * 20e6, 1e-3);
  // after 4 µm 40 + 30 N, after 8 µm 0 + 60 N; both peaks together would be 100 N
  EXPECT_NEAR(cut.peak, 70.0, 1e-9);
  EXPECT_NEAR(cut.peak_at, 4e-6, 1e-15);
  EXPECT_EQ(cut.damage_depth, (std::vector<double>{30e-6, 45e-6}));
  ASSERT_EQ(cut.delamination.size(), 1u);
  EXPECT_NEAR(cut.delamination[0], 15e-6, 1e-18);
  EXPECT_EQ(laminate_line(cut),
            "laminate of 4 mm: Fc 90 N, Ft 10 N, largest sum 70 N after 4 µm of cut, "
            "damaged depths of neighbours differ by up to 0.015 mm (plies do not interact)\n");
  const std::string table = laminate_table(study, run, cut);
  EXPECT_TRUE(table.starts_with("ply,angle[deg],thickness[m],run,Fc[N],Ft[N],Fc_peak[N],"
                                "metrics.cutting.specific_energy[J/m^3],damage_depth[m],delamination[m]\n"
                                "top,-60,0.001,down,36,4,40,"))
      << table;
  EXPECT_NE(table.find("\nlaminate,,0.004,,90,10,70,"), std::string::npos) << table;
  const std::string section = laminate_section(study, run, cut, {});
  EXPECT_NE(section.find("Plies do not interact"), std::string::npos);
  EXPECT_NE(section.find("<svg"), std::string::npos);
}

TEST_F(Laminates, a_laminate_is_not_known_while_a_ply_is_not) {
  read(two);
  const std::vector<std::size_t> run = runs_of_plies(study, runs, cuts);
  leave(0, 40.0, 4.0, 10e-6, 30e-6);
  const LaminateCut cut = cut_of_laminate(study, runs, run, temporary.path());
  EXPECT_NEAR(cut.Fc[0], 36.0, 1e-12);
  EXPECT_TRUE(std::isnan(cut.Fc_sum));
  EXPECT_TRUE(std::isnan(cut.peak));
  EXPECT_TRUE(std::isnan(cut.delamination[0]));
  EXPECT_TRUE(cut.forces.series.empty());
  EXPECT_EQ(laminate_line(cut), "laminate: a ply has no forces yet\n");
}

/// A ply is cut for 6 µm only, the last chip comes off after 9: larger sums may follow.
TEST_F(Laminates, the_largest_sum_is_not_known_where_a_ply_is_cut_too_short) {
  read(two);
  const std::vector<std::size_t> run = runs_of_plies(study, runs, cuts);
  leave(0, 40.0, 4.0, 10e-6, 30e-6, 6.0);
  leave(2, 20.0, 8.0, 45e-6, 5e-6);
  const LaminateCut cut = cut_of_laminate(study, runs, run, temporary.path());
  EXPECT_NEAR(cut.Fc_sum, 90.0, 1e-12);
  EXPECT_DOUBLE_EQ(cut.common, 6e-6);
  EXPECT_TRUE(std::isnan(cut.peak) && std::isnan(cut.peak_at));
  EXPECT_FALSE(cut.forces.series.empty());
  const std::string why = "a chip is not off after 6 µm, where the shortest cut of a ply ends";
  EXPECT_NE(laminate_line(cut).find(", largest sum not known: " + why), std::string::npos)
      << laminate_line(cut);
  EXPECT_NE(laminate_table(study, run, cut).find("\nlaminate,,0.004,,90,10,,"), std::string::npos);
  EXPECT_NE(laminate_section(study, run, cut, {}).find(why), std::string::npos);

  leave(0, 40.0, 4.0, 10e-6, 30e-6, 9.0); // as far as the last chip
  const LaminateCut enough = cut_of_laminate(study, runs, run, temporary.path());
  EXPECT_NEAR(enough.peak, 70.0, 1e-9);
  EXPECT_FALSE(enough.ends_early());
  EXPECT_EQ(laminate_section(study, run, enough, {}).find("not known"), std::string::npos);
}

TEST_F(Laminates, the_largest_sum_waits_for_no_chip_of_plies_that_break_off_none) {
  read(two);
  const std::vector<std::size_t> run = runs_of_plies(study, runs, cuts);
  leave(0, 10.0, 4.0, 10e-6, 30e-6);
  breaks = false;
  leave(2, 20.0, 8.0, 45e-6, 5e-6, 12.0);
  const LaminateCut cut = cut_of_laminate(study, runs, run, temporary.path());
  EXPECT_NEAR(cut.peak, 60.0, 1e-9); // after the only chip, which comes off after 5 µm
  EXPECT_NEAR(cut.peak_at, 8e-6, 1e-15);
  breaks = true;
  leave(0, 10.0, 14.0, 10e-6, 30e-6);
  EXPECT_TRUE(cut_of_laminate(study, runs, run, temporary.path()).ends_early());
}

TEST_F(Laminates, that_of_the_shipped_case_has_runs_for_its_plies) {
  study = read_study(CNEM_SOURCE_DIR "/cases/composites/gfrp/laminate.toml");
  for (int angle = -75; angle <= 90; angle += 15)
    runs.emplace_back().variables = {{"theta", angle * degree, "rad", ""}};
  ASSERT_EQ(study.runs.size(), runs.size());
  EXPECT_EQ(runs_of_plies(study, runs, std::vector<std::optional<CutConditions>>(runs.size(), cuts[0])),
            (std::vector<std::size_t>{5, 8, 2, 11, 2, 8, 5}));
}

/// As users call it, on coarse cells: fibres that lean to either side, negative angles too.
TEST_F(Laminates, a_sweep_ends_with_the_table_of_its_laminate) {
  const Study input = read_study_text(std::string(gfrp) + R"toml(
[set]
"let.spacing" = "50 um"
"time.end" = "22 us"
"output.pictures" = []
[grid]
"let.theta" = ["-45 deg", "45 deg"]
[laminate]
angle = "let.theta"
plies = [ { angle = "45 deg", thickness = "1 mm" }, { angle = "-45 deg", thickness = "1 mm" } ]
)toml",
                                      temporary.path() / "stack.toml");
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const Exit code =
      sweep(input, {.output = temporary.path() / "results", .program = CNEM_PROGRAM, .version = "test"});
  const std::string printed = ::testing::internal::GetCapturedStdout();
  const std::string told = ::testing::internal::GetCapturedStderr();
  ASSERT_EQ(code, Exit::done) << told;
  EXPECT_NE(printed.find("laminate of 2 mm: Fc "), std::string::npos) << printed;
  const std::string report = results::read_file(temporary.path() / "results" / "report.html");
  EXPECT_NE(report.find("Plies do not interact"), std::string::npos);
  const std::string table = results::read_file(temporary.path() / "results" / "laminate.csv");
  EXPECT_NE(table.find("\n1,45,0.001,theta_45_deg,"), std::string::npos) << table;
  EXPECT_NE(table.find("\n2,-45,0.001,theta_-45_deg,"), std::string::npos) << table;
  EXPECT_NE(table.find("\nlaminate,,0.002,,"), std::string::npos) << table;
}

} // namespace
} // namespace cnem::study
