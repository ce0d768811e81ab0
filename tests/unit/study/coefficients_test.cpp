// A cutting law from folders of made-up cuts.
#include "study/coefficients.hpp"

#include "evaluate/cutting_result.hpp"
#include "input/case_machining.hpp"
#include "input/case_reader.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
constexpr double one_degree = std::numbers::pi / 180.0;

class Coefficients : public ::testing::Test {
protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  /// A run of the sweep that has left a cut.
  evaluate::CuttingResult cut(double feed, double rake, double speed, double Fc, double Ft) const {
    evaluate::CuttingResult result;
    result.tool = "cutter";
    result.feed = feed;
    result.width = 2e-3;
    result.rake = rake * one_degree;
    result.speed = speed;
    result.steady = true;
    result.steady_from = feed;
    result.steady_to = 6.0 * feed;
    result.filter = 0.2 * feed;
    result.Fc = Fc;
    result.Fc_spread = 0.05 * Fc;
    result.Ft = Ft;
    result.Ft_spread = 0.05 * std::abs(Ft);
    result.chip_thickness = 2.0 * feed;
    return result;
  }
  void add(const evaluate::CuttingResult& result) {
    const std::string name = fmt::format("run_{}", manifest["runs"].size());
    evaluate::write_cutting(folder / name, result);
    manifest["runs"].push_back({{"name", name}, {"state", "done"}});
  }
  void add_failed(const std::string& name, const std::string& reason) {
    manifest["runs"].push_back({{"name", name}, {"state", "failed"}, {"exit", 3}, {"reason", reason}});
  }
  /// Linear, with a relative noise of a twentieth over the root of 25 parts.
  void add_linear(double rake, double speed, double Ktc, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    for (const double feed : {0.05e-3, 0.1e-3, 0.15e-3, 0.2e-3, 0.25e-3, 0.3e-3})
      add(cut(feed, rake, speed, (Ktc * feed + 20e3) * (1.0 + 0.01 * normal(engine)),
              (200e6 * feed + 15e3) * (1.0 + 0.01 * normal(engine))));
  }
  Exit run() {
    write("manifest.json", manifest.dump());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::exception_ptr problem;
    Exit code = Exit::done;
    try {
      code = coefficients(folder, "test");
    } catch (...) { problem = std::current_exception(); }
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    if (problem) std::rethrow_exception(problem);
    return code;
  }
  std::string refusal() {
    try {
      run();
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  Json json() const { return Json::parse(results::read_file(folder / "coefficients.json")); }
  input::Case milling(const std::vector<std::string>& set = {}) const {
    write("case.toml",
          "[analysis]\ntype = \"milling\"\n[cutter]\ndiameter = \"12 mm\"\nteeth = 3\n[cutting]\nlaw "
          "= \"law.toml\"\n[milling]\nspeed = \"3000 rpm\"\nfeed = \"0.1 mm\"\naxial_depth = \"2 mm\"\n");
    return input::read_case((folder / "case.toml").string(), set);
  }

  const cnem::testing::TemporaryFolder temporary{"coefficients"};
  const fs::path& folder = temporary.path();
  Json manifest{{"kind", "sweep"}, {"runs", Json::array()}};
  std::string printed, message;
};

TEST_F(Coefficients, made_up_cuts_come_back_within_their_standard_errors) {
  int within = 0, all = 0;
  for (unsigned seed = 1; seed <= 25; ++seed) {
    manifest["runs"] = Json::array();
    add_linear(10.0, 2.0, 800e6, seed);
    ASSERT_EQ(run(), Exit::done);
    const Json linear = json().at("all").at("linear");
    for (const auto& [key, truth] : {std::pair{"Ktc", 800e6}, {"Krc", 200e6}, {"Kte", 20e3}, {"Kre", 15e3}}) {
      const double value = linear.at(key).at("value"), error = linear.at(key).at("error");
      ++all;
      within += std::abs(value - truth) < error;
      EXPECT_LT(std::abs(value - truth), 4.5 * error) << key << ", seed " << seed;
    }
  }
  EXPECT_GT(within, 0.55 * all);
  EXPECT_LT(within, 0.85 * all);
}

TEST_F(Coefficients, its_law_is_one_that_milling_reads) {
  add_linear(10.0, 2.0, 800e6, 3);
  ASSERT_EQ(run(), Exit::done);
  const Json linear = json().at("all").at("linear");
  const auto force = [](const input::Case& input, double h) {
    return input.machining->cut.law.at({.thickness = h, .speed = 2.0}).force;
  };
  const double h = 0.1e-3;
  const Vec3 there = force(milling(), h);
  EXPECT_NEAR(there[0],
              linear.at("Ktc").at("value").get<double>() * h + linear.at("Kte").at("value").get<double>(),
              1e-6 * there[0]);
  EXPECT_NEAR(there[1],
              linear.at("Krc").at("value").get<double>() * h + linear.at("Kre").at("value").get<double>(),
              1e-6 * there[0]);
  EXPECT_NEAR(milling().machining->law_range.thickness.high, 0.3e-3, 1e-12);
  EXPECT_NEAR(milling().machining->law_range.rake.low, 10.0 * one_degree, 1e-9);
  // Straight edges: the oblique law of the shear plane is the linear one.
  EXPECT_NEAR(force(milling({"cutting.forces.law=oblique"}), h)[0], there[0], 1e-5 * there[0]);
  EXPECT_NEAR(force(milling({"cutting.forces.law=kienzle"}), h)[0], there[0], 0.05 * there[0]);
  EXPECT_NEAR(force(milling({"cutting.forces.law=table"}), h)[0], there[0], 0.03 * there[0]);
  const std::string page = results::read_file(folder / "coefficients.html");
  for (const char* part : {"A cutting law from chips", "Ktc", "shear angle", "R²", "<svg", "Cuts and laws"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_NE(results::read_file(folder / "coefficients.svg").find("<svg"), std::string::npos);
}

TEST_F(Coefficients, several_rakes_and_speeds_make_a_table) {
  for (const double rake : {0.0, 10.0})
    for (const double speed : {1.0, 2.0}) add_linear(rake, speed, 1000e6 - 20e6 * rake - 50e6 * speed, 7);
  ASSERT_EQ(run(), Exit::done);
  EXPECT_EQ(json().at("law"), "table");
  ASSERT_EQ(json().at("groups").size(), 4U);
  EXPECT_NEAR(json().at("groups").at(3).at("linear").at("Ktc").at("value").get<double>(), 700e6, 15e6);
  EXPECT_EQ(json().at("groups").at(3).at("speed"), 2.0);
  const auto force = [&](const char* rake) {
    return milling({rake}).machining->cut.law.at({.thickness = 0.2e-3, .speed = 2.0}).force[0];
  };
  EXPECT_NEAR(force("cutter.rake=0 deg"), 900e6 * 0.2e-3 + 20e3, 0.03 * 200e3);
  EXPECT_NEAR(force("cutter.rake=5 deg"), 800e6 * 0.2e-3 + 20e3, 0.03 * 200e3);
}

TEST_F(Coefficients, what_is_unsteady_or_failed_is_named_and_left_out) {
  add_linear(10.0, 2.0, 800e6, 3);
  evaluate::CuttingResult unsteady = cut(0.4e-3, 10.0, 2.0, 1e9, 1e9);
  unsteady.steady = false;
  unsteady.steady_note = "the force rises";
  add(unsteady);
  add_failed("wild", "the step fell to nothing");
  manifest["runs"].push_back({{"name", "late"}, {"state", "pending"}});
  ASSERT_EQ(run(), Exit::done);
  for (const char* part : {"left out: run_6: not steady: the force rises",
                           "left out: wild: failed: the step fell to nothing", "left out: late: pending"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
  EXPECT_EQ(json().at("left_out").size(), 3U);
  EXPECT_EQ(json().at("all").at("cuts"), 6);
  EXPECT_NO_THROW(milling());
}

TEST_F(Coefficients, forces_that_fall_with_the_thickness_are_no_law) {
  add(cut(0.1e-3, 10.0, 2.0, 1.2e5, 1e4));
  add(cut(0.2e-3, 10.0, 2.0, 1.0e5, 1e4));
  EXPECT_NE(refusal().find("tangential forces do not grow with the thickness of the chip"), std::string::npos)
      << refusal();
}

TEST_F(Coefficients, what_is_no_sweep_is_refused) {
  EXPECT_NE(refusal().find("found 0 steady cuts, expected two thicknesses"), std::string::npos) << refusal();
  add(cut(0.1e-3, 10.0, 2.0, 1e5, 1e4));
  add_failed("wild", "the step fell to nothing");
  EXPECT_NE(refusal().find("left out:\n  wild: failed: the step fell to nothing"), std::string::npos)
      << refusal();
  manifest["kind"] = "comparison";
  EXPECT_NE(refusal().find("holds the runs of a comparison, expected those of a sweep"), std::string::npos)
      << refusal();
  fs::remove(folder / "manifest.json");
  EXPECT_THROW(coefficients(folder, "test"), InputError);
  EXPECT_THROW(coefficients(folder / "nowhere", "test"), InputError);
}

} // namespace
} // namespace cnem::study
