// Constants and friction from forces and chips of made-up cuts: the shear zone in closed form stands for
// runs.
#include "evaluate/cutting_result.hpp"
#include "evaluate/material_point.hpp"
#include "input/case_reader.hpp"
#include "study/calibration_evaluator.hpp"
#include "tests/unit/study/calibrate_fixture.hpp"

#include <cmath>
#include <random>

namespace cnem::study {
namespace {

constexpr const char* cut_case = R"toml(
[cutting]
feed = "0.1 mm"
width = "2 mm"
rake = "0 deg"
clearance = "7 deg"
edge_radius = "5 um"
speed = "2 m/s"
length = "1 mm"
friction = { law = "coulomb", coefficient = 0.5 }
[domain]
material = "steel"
[materials.steel]
density = "7900 kg/m3"
elastic = { young = "200 GPa", poisson = 0.3 }
plastic = { law = "johnson-cook", A = "350 MPa", B = "700 MPa", n = 0.3, C = 0.02, rate0 = "1 /s", m = 1.0, T0 = "293 K", Tmelt = "1700 K" }
heat = { specific_heat = "500 J/(kg K)", conductivity = "16 W/(m K)" }
)toml";

struct Sought {
  std::string name, key;
  double truth;
  std::string unit;
};
const std::vector<Sought> all_constants{
    {"A", "materials.steel.plastic.A", 350.0, " MPa"}, {"B", "materials.steel.plastic.B", 700.0, " MPa"},
    {"n", "materials.steel.plastic.n", 0.3, ""},       {"C", "materials.steel.plastic.C", 0.02, ""},
    {"m", "materials.steel.plastic.m", 1.0, ""},       {"friction", "cutting.friction.coefficient", 0.5, ""}};

struct Settings {
  double feed, speed, rake; ///< mm, m/s, deg
  std::vector<std::string> set() const {
    return {fmt::format("cutting.feed={} mm", feed), fmt::format("cutting.speed={} m/s", speed),
            fmt::format("cutting.rake={} deg", rake)};
  }
};
const std::vector<Settings> eight_cuts{{0.1, 1, 0},  {0.25, 1, 0},  {0.1, 4, 0},  {0.25, 4, 0},
                                       {0.1, 1, 10}, {0.25, 1, 10}, {0.1, 4, 10}, {0.25, 4, 10}};

class CalibrateCuts : public Calibrate {
protected:
  void SetUp() override { write("case.toml", cut_case); }

  input::Case input(std::vector<std::string> set, const Settings& cut) const {
    for (std::string& one : cut.set()) set.push_back(std::move(one));
    return input::read_case((folder / "case.toml").string(), set);
  }
  /// Targets with noise, whose standard error they know. fitted: how many of them; the others are left out.
  std::string targets(const std::vector<Settings>& cuts, double noise, unsigned seed,
                      std::size_t fitted = 100) const {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    std::string text;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const auto exact = *closed_form_cut(input({}, cuts[k]));
      text += fmt::format(
          "[targets.cut_{}]\n{}set = {{ \"cutting.feed\" = \"{} mm\", \"cutting.speed\" = \"{} m/s\", "
          "\"cutting.rake\" = \"{} deg\" }}\n",
          k, k < fitted ? "" : "weight = 0\n", cuts[k].feed, cuts[k].speed, cuts[k].rake);
      for (const auto& [key, value, unit] : {std::tuple{"Fc", 2e-3 * exact.Fc, "N"},
                                             {"Ft", 2e-3 * exact.Ft, "N"},
                                             {"chip_thickness", 1e3 * exact.chip_thickness, "mm"}})
        text += fmt::format("{0} = \"{1:.6g} {2}\"\n{0}_error = \"{3} %\"\n", key,
                            value * (1.0 + noise * normal(engine)), unit, 100.0 * noise);
    }
    return text;
  }
  /// Looked for from 30% off, up for every second one.
  static std::string parameters() {
    std::string text;
    for (std::size_t k = 0; k < all_constants.size(); ++k) {
      const auto& [name, key, truth, unit] = all_constants[k];
      const auto written = [&](double factor) {
        return unit.empty() ? fmt::format("{:.6g}", factor * truth)
                            : fmt::format("\"{:.6g}{}\"", factor * truth, unit);
      };
      text += fmt::format("[parameters.{}]\nkey = \"{}\"\nstart = {}\nlow = {}\nhigh = {}\nscale = \"log\"\n",
                          name, key, written(k % 2 == 0 ? 1.3 : 0.7), written(0.4), written(2.5));
    }
    return text;
  }
  std::vector<std::string> found() const {
    std::vector<std::string> set;
    const Json constants = result().at("constants");
    for (const auto& [name, key, truth, unit] : all_constants)
      set.push_back(fmt::format(
          "{}={}{}", key, constants.at(name).at("value").get<double>() / (unit.empty() ? 1.0 : 1e6), unit));
    return set;
  }
};

/// Root mean square of what values are off their truth, as a share of it.
double off(const std::vector<std::pair<double, double>>& values) {
  double squares = 0.0;
  for (const auto& [value, truth] : values) squares += (value / truth - 1.0) * (value / truth - 1.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST_F(CalibrateCuts, eight_noisy_cuts_tell_flow_stress_forces_and_friction) {
  int told = 0, inside = 0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    force = true;
    ASSERT_EQ(
        run("cuts = \"shear-zone\"\nevaluations = 60\n" + parameters() + targets(eight_cuts, 0.02, seed)), 0)
        << message;
    const std::vector<std::string> set = found();
    std::vector<std::pair<double, double>> flow;
    for (const Settings& cut : eight_cuts) {
      const auto met = *closed_form_cut(input({}, cut));
      flow.emplace_back(
          evaluate::flow_stress_of(input(set, cut).material("steel"), met.strain, met.rate, met.temperature),
          met.flow_stress);
    }
    EXPECT_LT(off(flow), 0.03) << "seed " << seed;
    for (const Settings& unseen : {Settings{0.17, 2.0, 5}, {0.3, 1.5, 0}, {0.07, 6.0, 10}}) {
      const auto truth = *closed_form_cut(input({}, unseen)), here = *closed_form_cut(input(set, unseen));
      EXPECT_NEAR(here.Fc / truth.Fc, 1.0, 0.03) << "seed " << seed;
      EXPECT_NEAR(here.Ft / truth.Ft, 1.0, 0.03) << "seed " << seed;
    }
    const Json constants = result().at("constants");
    EXPECT_TRUE(constants.at("friction").at("told"));
    for (const auto& [name, key, truth, unit] : all_constants) {
      const Json& one = constants.at(name);
      if (!one.at("told")) continue;
      const double si = truth * (unit.empty() ? 1.0 : 1e6);
      ++told;
      inside += one.at("interval").at(0) < si && si < one.at("interval").at(1);
    }
  }
  EXPECT_GE(inside, told - 1) << "95% intervals of " << told;
}

/// BOBYQA alone ends along weak directions where its budget does, a standard error off.
TEST_F(CalibrateCuts, the_end_is_that_of_least_squares_however_long_the_search_was) {
  std::vector<Json> ends;
  for (const int evaluations : {20, 90}) {
    force = true;
    ASSERT_EQ(run(fmt::format("cuts = \"shear-zone\"\nevaluations = {}\n", evaluations) + parameters() +
                  targets(eight_cuts, 0.01, 4)),
              0)
        << message;
    ends.push_back(result());
  }
  EXPECT_NEAR(ends[0].at("misfit").at("best").get<double>() / ends[1].at("misfit").at("best").get<double>(),
              1.0, 1e-4);
  for (const auto& [name, one] : ends[0].at("constants").items()) {
    const Json& other = ends[1].at("constants").at(name);
    if (!one.at("told") || !other.at("told")) continue;
    const double width = one.at("interval").at(1).get<double>() - one.at("interval").at(0).get<double>();
    EXPECT_NEAR(one.at("value"), other.at("value").get<double>(), 0.05 * width) << name;
  }
}

TEST_F(CalibrateCuts, what_is_left_out_is_compared_and_not_fitted) {
  const std::string head = "cuts = \"shear-zone\"\nevaluations = 40\n" + parameters();
  ASSERT_EQ(run(head + targets(eight_cuts, 0.02, 1), "all"), 0) << message;
  std::vector<Settings> ten = eight_cuts;
  ten.push_back({0.17, 2.0, 5});
  ten.push_back({0.3, 1.5, 0});
  ASSERT_EQ(run(head + targets(ten, 0.02, 1, eight_cuts.size()), "some"), 0) << message;
  EXPECT_EQ(result("all").at("constants"), result("some").at("constants")) << "to the bit";
  EXPECT_EQ(result("all").at("not_told"), result("some").at("not_told"));
  int left_out = 0;
  const Json some = result("some");
  for (const Json& curve : some.at("curves")) {
    const std::string name = curve.at("name");
    EXPECT_EQ(curve.at("fitted"), !(name.starts_with("cut_8") || name.starts_with("cut_9"))) << name;
    if (curve.at("fitted")) continue;
    ++left_out;
    EXPECT_NEAR(curve.at("computed").get<double>() / curve.at("measured").get<double>(), 1.0, 0.08) << name;
    EXPECT_GT(curve.at("rms_share_start").get<double>(), curve.at("rms_share").get<double>()) << name;
  }
  EXPECT_EQ(left_out, 6);
  EXPECT_NE(printed.find("misfit of what is left out: "), std::string::npos) << printed;
  EXPECT_NE(results::read_file(folder / "some/report.html").find("Fc (left out)"), std::string::npos);
}

TEST_F(CalibrateCuts, two_cuts_say_what_they_do_not_tell) {
  ASSERT_EQ(run("cuts = \"shear-zone\"\nevaluations = 60\n" + parameters() +
                targets({eight_cuts[0], eight_cuts[7]}, 0.02, 1)),
            0)
      << message;
  const Json constants = result().at("constants");
  EXPECT_FALSE(result().at("not_told").empty());
  for (const char* name : {"C", "m"}) EXPECT_FALSE(constants.at(name).at("told")) << name;
  EXPECT_NE(printed.find("The curves do not tell"), std::string::npos) << printed;
  const Json values = result().at("logarithmic_singular_values");
  ASSERT_EQ(values.size(), 6U);
  EXPECT_LT(values.at(5).get<double>(), 0.01 * values.at(0).get<double>());
  const std::string page = results::read_file(folder / "results/report.html");
  for (const char* part : {"chip_thickness", "standard error", "What the curves do not tell"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(CalibrateCuts, runs_on_another_cloud_tell_the_yield_stress) {
  write("case.toml", R"toml(
[cutting]
feed = "0.3 mm"
width = "1 mm"
rake = "17.5 deg"
clearance = "7 deg"
edge_radius = "30 um"
speed = "800 m/min"
length = "0.5 mm"
friction = { law = "coulomb", coefficient = 0 }
[domain]
material = "steel"
[cloud]
spacing = "0.15 mm"
refine.layer.spacing = "0.1 mm"
[materials.steel]
density = "2700 kg/m3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "perfect", yield = "440 MPa" }
[adapt]
resample = false
[output]
pictures = []
)toml");
  ASSERT_EQ(program({"run", (folder / "case.toml").string(), "--output", (folder / "truth").string(), "--set",
                     "cloud.pattern=jittered", "--threads", "1"}),
            0);
  const auto truth = *evaluate::read_cutting_numbers(folder / "truth");
  ASSERT_EQ(run(fmt::format("evaluations = 8\n[parameters.yield]\nkey = \"materials.steel.plastic.yield\"\n"
                            "start = \"310 MPa\"\nlow = \"200 MPa\"\nhigh = \"700 MPa\"\n[targets.cut]\n"
                            "Fc = \"{} N/mm\"\nFc_error = \"2 %\"\n",
                            1e-3 * truth.Fc)),
            0)
      << message;
  const Json yield = result().at("constants").at("yield");
  EXPECT_NEAR(yield.at("value").get<double>(), 440e6, 0.03 * 440e6);
  EXPECT_TRUE(yield.at("told")) << "by the error that is given";
  EXPECT_LT(yield.at("interval").at(0), 440e6);
  EXPECT_NE(message.find("cut Fc: the computed cut is not steady"), std::string::npos) << message;
}

} // namespace
} // namespace cnem::study
