// Constants found again from curves that are known: of single points, of runs on another cloud, after a kill;
// and what curves do not tell.
#include "tests/unit/study/calibrate_fixture.hpp"

#include <algorithm>
#include <random>

namespace cnem::study {
namespace {

TEST_F(Calibrate, finds_johnson_cook_again_from_curves_of_single_points) {
  write_curve("slow", 1.0, 350, 400, 0.3, 0.02);
  write_curve("fast", 1000.0, 350, 400, 0.3, 0.02);
  ASSERT_EQ(run("evaluations = 600\ntolerance = 1e-6\n" +
                constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") +
                constant("B", "\"600 MPa\"", "\"100 MPa\"", "\"1.5 GPa\"", "log") +
                constant("n", "0.45", "0.1", "0.8") + constant("C", "0.01", "0.002", "0.1", "log") +
                curve("slow", 1.0) + curve("fast", 1000.0)),
            0)
      << message;
  const Json constants = result().at("constants");
  for (const auto& [name, truth] : {std::pair{"A", 350e6}, {"B", 400e6}, {"n", 0.3}, {"C", 0.02}}) {
    EXPECT_NEAR(constants.at(name).at("value").get<double>() / truth, 1.0, 0.01) << name;
    EXPECT_TRUE(constants.at(name).at("told")) << name;
  }
  EXPECT_LT(result().at("misfit").at("best").get<double>(), 1e-3);
  const std::string snippet = results::read_file(folder / "results/calibrated.toml");
  EXPECT_NE(snippet.find("materials.steel.plastic.A = \"35"), std::string::npos) << snippet;
  const std::string page = results::read_file(folder / "results/report.html");
  for (const char* part : {"the curves tell all constants", "95% band", "Correlations", "Sensitivity"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(Calibrate, says_which_constants_the_curves_do_not_tell) {
  write_curve("slow", 1.0, 350, 400, 0.3, 0.02);
  const std::string yield = constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\""),
                    rate = constant("C", "0.01", "0.002", "0.1", "log");
  ASSERT_EQ(run("evaluations = 60\n[set]\n\"materials.steel.plastic.B\" = \"400 MPa\"\n"
                "\"materials.steel.plastic.n\" = 0.3\n" +
                yield + rate + curve("slow", 1.0)),
            0)
      << message;
  EXPECT_NEAR(result().at("constants").at("A").at("value").get<double>() / 350e6, 1.0, 0.01);
  EXPECT_TRUE(result().at("constants").at("A").at("told"));
  EXPECT_FALSE(result().at("constants").at("C").at("told"));
  EXPECT_NE(printed.find("The curves do not tell C: from 0.002 to 0.1"), std::string::npos) << printed;

  write_curve("fast", 1000.0, 350, 0, 0.3, 0.02);
  ASSERT_EQ(run("evaluations = 60\n[set]\n\"materials.steel.plastic.B\" = \"0 MPa\"\n" + yield + rate +
                    curve("fast", 1000.0),
                "one_rate"),
            0)
      << message;
  const std::string words = result("one_rate").at("not_told").at(0);
  EXPECT_NE(words.find("The curves do not tell A and C apart"), std::string::npos) << words;
  EXPECT_FALSE(result("one_rate").at("constants").at("A").at("told"));
}

TEST_F(Calibrate, a_single_constant_is_found_too) {
  write_curve("slow", 1.0, 350, 400, 0.3, 0.02);
  ASSERT_EQ(run("evaluations = 40\n[set]\n\"materials.steel.plastic.B\" = \"400 MPa\"\n"
                "\"materials.steel.plastic.n\" = 0.3\n" +
                constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"") + curve("slow", 1.0)),
            0)
      << message;
  EXPECT_NEAR(result().at("constants").at("A").at("value").get<double>() / 350e6, 1.0, 0.01);
}

TEST_F(Calibrate, finds_the_flow_stress_from_a_run_on_another_cloud_also_after_a_kill) {
  press_block("0.14 mm");
  const std::string text = "evaluations = 26\nprocesses = 2\n" +
                           constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") +
                           constant("B", "\"700 MPa\"", "\"100 MPa\"", "\"1.5 GPa\"", "log") +
                           "[targets.press]\n";
  ASSERT_EQ(run(text), 0) << message;
  const Json constants = result().at("constants");
  const double A = constants.at("A").at("value"), B = constants.at("B").at("value");
  for (const double strain : {0.05, 0.15, 0.25})
    EXPECT_NEAR(stress(strain, 1.0, A, B, 0.4, 0.01) / stress(strain, 1.0, 350e6, 400e6, 0.4, 0.01), 1.0,
                0.03)
        << strain << ", A = " << A << ", B = " << B;
  EXPECT_LT(result().at("misfit").at("best").get<double>(), 0.03);
  const std::size_t whole = runs("results");

  const std::vector<std::string> words{"calibrate", (folder / "fit.toml").string(), "--output",
                                       (folder / "killed").string()};
  EXPECT_EQ(program(words, [&] { return runs("killed") >= 7; }), -SIGKILL);
  const std::size_t before = runs("killed");
  EXPECT_LT(before, whole);
  ASSERT_EQ(run(text, "killed"), 0) << message;
  EXPECT_EQ(runs("killed"), whole);
  std::size_t again = 0;
  for (std::size_t at = printed.find("  run "); at != std::string::npos; at = printed.find("  run ", at + 1))
    ++again;
  EXPECT_LE(again, whole - before) << "what was done is not run again\n" << printed;
  for (const char* file : {"calibration.csv", "calibration.json", "calibrated.toml"})
    EXPECT_EQ(results::read_file(folder / "results" / file), results::read_file(folder / "killed" / file))
        << file;
}

/// BOBYQA of so few evaluations ends far from the least misfit, and intervals are those of the least.
TEST_F(Calibrate, few_steps_of_least_squares_end_a_search_by_runs) {
  press_block("0.2 mm");
  ASSERT_EQ(run("evaluations = 8\nprocesses = 2\n" +
                constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") +
                constant("B", "\"700 MPa\"", "\"100 MPa\"", "\"1.5 GPa\"", "log") + "[targets.press]\n"),
            0)
      << message;
  const Json constants = result().at("constants");
  EXPECT_NEAR(constants.at("A").at("value").get<double>(), 350e6, 7e6);
  EXPECT_NEAR(constants.at("B").at("value").get<double>(), 400e6, 8e6);
  EXPECT_LE(result().at("evaluations").get<int>(), 8 + 8 * 2 + 12);
}

TEST_F(Calibrate, runs_that_fail_are_bad_misfits_and_told) {
  ASSERT_EQ(run("evaluations = 6\n[set]\n\"time.end\" = \"2 us\"\n\"time.step.fixed\" = \"1 us\"\n" +
                constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") + "[targets.press]\n"),
            3);
  EXPECT_NE(message.find("no evaluation went well"), std::string::npos) << message;
}

TEST_F(Calibrate, runs_that_the_machine_ended_say_nothing_of_constants) {
  const std::string text = "evaluations = 6\n" +
                           constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") +
                           "[targets.press]\n";
  program_file = folder / "machine.sh";
  for (const auto& [end, words] : {std::pair{"kill -9 $$", "was killed by signal 9"},
                                   {"echo no space left; exit 4", "ended with exit code 4: no space left"}}) {
    write("machine.sh", fmt::format("#!/bin/sh\n{}\n", end));
    fs::permissions(program_file, fs::perms::owner_all);
    try {
      run(text, "ended");
      ADD_FAILURE() << end;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("ended/runs/press-"), std::string::npos) << error.what();
    }
  }
}

TEST_F(Calibrate, force_removes_nothing_but_its_own_runs) {
  write_curve("slow", 1.0, 350, 400, 0.3, 0.02);
  const fs::path runs = folder / "results/runs";
  const std::string hash = "-0123456789abcdef";
  fs::create_directories(runs / ("slow" + hash));
  for (const char* other : {"slow", "slow-0123", "fast-0123456789abcdef"})
    fs::create_directories(runs / other);
  write("results/runs/notes.txt", "mine");
  write("results/runs/slow" + hash + ".log", "");
  force = true;
  ASSERT_EQ(run("evaluations = 6\n" + constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"") +
                curve("slow", 1.0)),
            0)
      << message;
  for (const char* other : {"slow", "slow-0123", "fast-0123456789abcdef", "notes.txt"})
    EXPECT_TRUE(fs::exists(runs / other)) << other;
  EXPECT_FALSE(fs::exists(runs / ("slow" + hash)));
  EXPECT_FALSE(fs::exists(runs / ("slow" + hash + ".log")));
}

TEST_F(Calibrate, measured_points_beyond_the_run_are_left_out_and_told) {
  write("press.csv", "stroke[mm];force[kN]\n0;0\n0,1;12\n0,3;20\n1;500\n");
  ASSERT_EQ(run("evaluations = 6\n" + constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"", "log") +
                "[targets.press]\n"),
            0)
      << message;
  EXPECT_LT(result().at("curves").at(0).at("rms_share").get<double>(), 0.02) << "of the peak of 500 kN";
  EXPECT_NE(message.find("measured from 0 mm to 1 mm, compared from 0 mm to 0.2"), std::string::npos)
      << message;
  EXPECT_NE(results::read_file(folder / "results/report.html").find("the run goes no farther"),
            std::string::npos);
}

TEST_F(Calibrate, a_key_has_one_value) {
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      run("evaluations = 12\n" + text + "[targets.press]\n");
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  };
  const std::string A = constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"");
  std::string again = constant("B", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"");
  again.replace(again.find("plastic.B"), 9, "plastic.A");
  const std::string twice = refusal(A + again);
  EXPECT_NE(twice.find("'parameters.B.key': found 'materials.steel.plastic.A', which parameters.A"),
            std::string::npos)
      << twice;
  const std::string set = refusal("set = { \"materials.steel.plastic.A\" = \"300 MPa\" }\n" + A);
  EXPECT_NE(set.find("found set where parameters.A"), std::string::npos) << set;
  const std::string bound = refusal(constant("A", "\"250 MPa\"", "100", "\"800 MPa\"", "log"));
  EXPECT_NE(bound.find("'parameters.A.low': found 100, expected a stress"), std::string::npos) << bound;
  EXPECT_EQ(bound.find("more than 0"), std::string::npos) << "what was not read is not judged\n" << bound;
}

TEST_F(Calibrate, points_left_out_and_units_that_cannot_be_are_told) {
  write("press.csv", "stroke[mm];force[kN]\n0;0\n0,1;12\n0,05;8\n");
  write("pull.csv", "plastic strain;stress[MPa]\n0,002;300\n0,2;500\n0,1;400\n");
  ASSERT_EQ(run("evaluations = 6\n" + constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"") +
                curve("pull", 1.0) + "[targets.press]\n"),
            0)
      << message;
  for (const char* part :
       {"targets.pull.file: 1 of 3 points", "target 'press': report.experiment.measured: 1 of 3 points"})
    EXPECT_NE(message.find(part), std::string::npos) << part << message;
  write("press.csv", "stroke[mm];force[N]\n0;0\n0,1;12\n");
  force = true;
  ASSERT_EQ(run("evaluations = 6\n" + constant("A", "\"250 MPa\"", "\"100 MPa\"", "\"800 MPa\"") +
                "[targets.press]\n"),
            0);
  EXPECT_NE(message.find("are the columns in the units that are meant?"), std::string::npos) << message;
  EXPECT_EQ(result().at("warnings").size(), 1U);
}

TEST_F(Calibrate, what_went_well_is_better_than_what_failed) {
  write("weak.csv", "plastic strain;stress[MPa]\n0,002;10\n0,4;10\n");
  // The second start, between the bounds, melts below its T0; all others are far worse than a failure counts.
  ASSERT_EQ(run("evaluations = 12\nstarts = 2\n" + constant("T0", "\"293 K\"", "\"200 K\"", "\"890 K\"") +
                constant("Tmelt", "\"895 K\"", "\"300 K\"", "\"900 K\"") + curve("weak", 1.0)),
            0)
      << message;
  EXPECT_GT(result().at("failures").get<int>(), 0);
  EXPECT_GT(result().at("misfit").at("best").get<double>(), 2.0);
}

/// A target that is left out fails at what was found, which is the start too: its best constant is a bound.
TEST_F(Calibrate, what_is_left_out_and_fails_is_told_once_and_counts_in_no_misfit) {
  write_curve("slow", 1.0, 60, 400, 0.3, 0.02);
  write("case.toml", std::string(block) +
                         "[report.experiment.one]\nfile = \"press.csv\"\ncut_length = \"20 mm\"\n" +
                         "[report.experiment.two]\nfile = \"far.csv\"\ncut_length = \"20 mm\"\n");
  write("far.csv", "stroke[mm];force[kN]\n5;0\n6;12\n");
  const auto warnings = [&](const std::string& target) {
    force = true;
    EXPECT_EQ(run("evaluations = 6\n" + constant("A", "\"100 MPa\"", "\"100 MPa\"", "\"800 MPa\"") +
                  curve("slow", 1.0) + "[targets.press]\nweight = 0\n" + target),
              0)
        << message;
    EXPECT_EQ(result().at("constants").at("A").at("value").get<double>(), 100e6);
    EXPECT_EQ(result().at("curves").size(), 1U) << result().at("curves");
    EXPECT_EQ(printed.find("misfit of what is left out"), std::string::npos) << printed;
    const auto all = result().at("warnings").get<std::vector<std::string>>();
    return std::count_if(all.begin(), all.end(), [](const std::string& one) {
      return one.starts_with("left out, and not compared: press");
    });
  };
  EXPECT_EQ(warnings("set = { \"time.end\" = \"2 us\", \"time.step.fixed\" = \"1 us\" }\n"), 1);
  EXPECT_EQ(warnings(""), 1) << "one of its two curves is compared before the other fails";
}

Calibration two_lines() {
  Calibration calibration;
  calibration.title = "two\nlines";
  for (const char* name : {"A", "B", "C"}) {
    SoughtConstant& constant = calibration.constants.emplace_back();
    constant.name = constant.key = name;
  }
  return calibration;
}

TEST(CalibrationInference, quantiles_are_those_of_tables) {
  for (const auto& [degrees, quantile] :
       {std::pair{1.0, 12.7062}, {2.0, 4.3027}, {3.0, 3.1824}, {10.0, 2.2281}, {120.0, 1.9799}})
    EXPECT_NEAR(student_quantile(degrees), quantile, 1e-4) << degrees;
  EXPECT_NEAR(student_quantile(1.5), 6.02, 0.01);
  EXPECT_TRUE(std::isfinite(student_quantile(1e-3)));
}

/// White noise counts as it is; through a Gaussian as wide as the points are apart 1/(1 + 2 Σ exp(−k²/4)) of
/// it.
TEST(CalibrationInference, residuals_count_by_their_correlations) {
  constexpr int count = 4000, reach = 6;
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(count + 2 * reach), passed = Eigen::VectorXd::Zero(count);
  for (double& one : noise) one = normal(generator);
  for (int k = 0; k < count; ++k)
    for (int j = -reach; j <= reach; ++j) passed[k] += noise[k + reach + j] * std::exp(-0.5 * j * j);
  const auto independent = [&](const Eigen::VectorXd& residual) {
    return infer(two_lines(), residual, Eigen::MatrixXd::Random(count, 3), {std::size_t(count)}).independent;
  };
  EXPECT_NEAR(independent(noise.head(count)) / count, 1.0, 0.1);
  EXPECT_NEAR(independent(passed) / count, 1.0 / 3.545, 0.05);
}

TEST(CalibrationInference, without_residuals_to_spare_there_are_no_intervals) {
  const Eigen::MatrixXd jacobian{{1.0, 0.0, 1.0}, {0.0, 1.0, 0.0}};
  const Inference few = infer(two_lines(), Eigen::Vector2d(0.01, -0.01), jacobian, {2});
  EXPECT_EQ(few.singular.size(), 3);
  EXPECT_EQ(few.singular[2], 0.0);
  EXPECT_FALSE(few.intervals());
  EXPECT_EQ(few.told, (std::vector{false, true, false}));
  EXPECT_NE(
      few.words.front().find("no intervals: the curves come to 2.0 independent residuals for 3 constants"),
      std::string::npos)
      << few.words.front();
}

TEST(CalibrationInference, a_sensitivity_that_is_not_known_is_not_a_sensitivity_of_nothing) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Random(20, 3);
  jacobian.col(1).setConstant(std::nan(""));
  Eigen::VectorXd residual(20);
  for (Eigen::Index k = 0; k < 20; ++k) residual[k] = k % 2 ? 1e-3 : -1e-3;
  const Inference inference = infer(two_lines(), residual, jacobian, {20});
  EXPECT_EQ(inference.told, (std::vector{true, false, true}));
  ASSERT_EQ(inference.words.size(), 1U);
  EXPECT_NE(inference.words[0].find("depend on B is not known, because the evaluations beside"),
            std::string::npos)
      << inference.words[0];
  EXPECT_GT(inference.half_width[0], 0.0);
  EXPECT_TRUE(inference.covariance.allFinite());
}

TEST(CalibrationFiles, titles_stay_comments_and_a_failed_start_has_no_misfit) {
  CalibrationResult result;
  result.start.failure = "as asked";
  result.start.misfit = failed_misfit;
  result.best.place = Eigen::Vector3d(0.5, 0.5, 0.5);
  result.inference = infer(two_lines(), Eigen::VectorXd::Zero(20), Eigen::MatrixXd::Random(20, 3), {20});
  const CalibrationFiles files = calibration_files(two_lines(), result, {}, "test");
  EXPECT_NE(files.constants.find("two lines: misfit 0% of the measured peaks, failed at the start"),
            std::string::npos)
      << files.constants;
  EXPECT_EQ(input::parse_document(files.constants, "calibrated.toml").members.size(), 3U);
}

} // namespace
} // namespace cnem::study
