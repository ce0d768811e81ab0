// What a run of a blank will take, before it has begun.
#include "app/forecast/shear_plane.hpp"
#include "app/forecast/wanted_nodes.hpp"
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "tests/shared_cases.hpp"
#include "tests/solver_of.hpp"
#include "tests/unit/app/forecast_fixture.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

// Half of a sheet, cut to a third of its thickness with the cells of its indicator.
const std::string sheet = testing::steel_304l + R"toml(
[time]
end = "22 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 1 mm" }
[cloud]
spacing = "0.125 mm"
[boundary.left]
pieces = ["left"]
symmetry = true
[tools.punch]
rectangle = { from = "-1 1 mm", to = "2 4 mm" }
velocity = "0 -15 m/s"
[tools.die]
rectangle = { from = "2.1 -3 mm", to = "9 0 mm" }
[tools.holder]
rectangle = { from = "2.2 1 mm", to = "9 3 mm" }
[method]
rereference = { every = 100, strain = 0.25 }
[adapt]
resample = true
tool_spacing = "60 um"
[adapt.indicator]
field = "plastic_strain"
h_min = "40 um"
[report.blanking]
[output]
pictures = []
)toml";

input::Case read(const std::vector<std::string>& overrides = {}, const std::string& text = sheet) {
  return input::read_case_text(text, "case.toml", overrides);
}

std::string without(const std::string& part) {
  std::string text = sheet;
  return text.erase(text.find(part), part.size());
}

TEST(ForecastOfABlank, FitsItsRun) { expect_that_it_fits_its_run(read()); }

TEST(ForecastOfABlank, IsThatOfTheToolsWithoutAReport) {
  const Forecast reported = expected_of(read()), bare = expected_of(read({}, without("[report.blanking]")));
  EXPECT_EQ(bare.nodes_last, reported.nodes_last);
  EXPECT_EQ(bare.steps, reported.steps);
}

TEST(ForecastOfABlank, GoesWithTheToleranceOfTheIndicator) {
  const Forecast usual = expected_of(read()), strict = expected_of(read({"adapt.indicator.tolerance=0.03"})),
                 loose = expected_of(read({"adapt.indicator.tolerance=1.5"})),
                 few = expected_of(read({"adapt.indicator.max_nodes=500"}));
  EXPECT_GT(strict.nodes_last, 1.1 * usual.nodes_last);
  EXPECT_EQ(*usual.indicated, 40e-6);
  EXPECT_LT(loose.nodes_last, 0.8 * usual.nodes_last);
  EXPECT_GT(*loose.indicated, 60e-6) << "h_min is not reached";
  EXPECT_LE(few.nodes_last, 500.0);
}

TEST(ForecastOfABlank, WarnsOfAnIndicatorThatHardlyRefines) {
  const auto warnings = [](const std::string& override) {
    std::string all;
    for (const std::string& one : check(read({"adapt.indicator.h_min=15 um", override}),
                                        {.output = {}, .threads = 1, .version = "test"})
                                      .warnings)
      all += one + "\n";
    return all;
  };
  EXPECT_EQ(warnings("adapt.indicator.tolerance=0.03").find("adapt.indicator.tolerance"), std::string::npos);
  EXPECT_NE(warnings("adapt.indicator.tolerance=1.5").find("lower it, or raise h_min"), std::string::npos);
  EXPECT_NE(warnings("adapt.indicator.field=temperature").find("it counts from 0 K"), std::string::npos);
}

TEST(ForecastOfABlank, LeavesWhatIsFineAlready) {
  const std::string fine = "cloud.refine.band={ box = [\"1.7 0 mm\", \"2.4 1 mm\"], spacing = \"40 um\" }";
  const Forecast coarse = expected_of(read()), refined = expected_of(read({fine}));
  EXPECT_NEAR(refined.nodes_last, coarse.nodes_last, 0.25 * coarse.nodes_last);
  EXPECT_GT(refined.nodes_first, 1.5 * coarse.nodes_first);
}

TEST(ForecastOfABlank, KnowsThatNothingFlowsYet) {
  const Forecast early = expected_of(read({"time.end=50 ns"}));
  EXPECT_EQ(early.nodes_last, early.nodes_first);
  EXPECT_FALSE(early.indicated);
  const std::string clear = "tools.punch.rectangle={ from = \"-1 1.2 mm\", to = \"2 4 mm\" }"; // 13 of 22 µs
  EXPECT_LT(expected_of(read({clear})).steps, 0.8 * expected_of(read()).steps);
}

TEST(ForecastOfABlank, CapsStepsAfterTheyHaveBeenScaled) {
  const double most = 2e-9;
  const Forecast capped = expected_of(read({"time.step.max=2 ns"}));
  EXPECT_LT(capped.steps, 1.35 * 22e-6 / most);
  EXPECT_GE(capped.steps, 22e-6 / most);
}

TEST(WantedNodes, FillABandAndItsFlanks) {
  const input::Case input = read({"adapt.tool_spacing=1 mm"});
  const ExplicitSolver<2> solver = testing::solver_of(input);
  const Cloud<2>& cloud = solver.conditions().cloud;
  const adapt::Structure structure = adapt::build_structure(cloud, Space::plane);
  const WantedNodes wanted(input, cloud, structure);
  EXPECT_EQ(wanted.added({}), 0.0);
  const double coarse = wanted.spacing_at({2.0e-3, 0.5e-3}), fine = 25e-6, width = 0.4e-3, height = 1e-3;
  const Band band{.at = {2e-3, 0.5e-3}, .across = {1, 0}, .width = width, .spacing = fine};
  EXPECT_DOUBLE_EQ(band.distance({2.3e-3, 0.1e-3}), 0.3e-3 - 0.5 * width);
  const double flank = (coarse - fine) / input.adapt.growth; // ∫ ds/h² of a spacing that grows
  const double expected =
      height / adapt::hexagon *
      (width / (fine * fine) + 2.0 * flank / (fine * coarse) - (width + 2.0 * flank) / (coarse * coarse));
  EXPECT_NEAR(wanted.added({band}), expected, 0.03 * expected);
  EXPECT_EQ(wanted.added({band, band}), wanted.added({band}));
}

TEST(ShearPlane, MakesAChipAsThickAsTheFeedWithoutFrictionAndHardening) {
  EXPECT_NEAR(foretold_chip_ratio(0.0, 0.0, 0.0), 1.0, 1e-6);
  EXPECT_GT(foretold_chip_ratio(0.0, 0.3, 0.0), 1.3);
  EXPECT_GT(foretold_chip_ratio(0.0, 0.0, 0.1), 1.1);
  EXPECT_LT(foretold_chip_ratio(0.5, 0.3, 0.1), foretold_chip_ratio(0.0, 0.3, 0.1));
  EXPECT_LE(foretold_chip_ratio(-0.5, 1.5, 2.0), 4.0);
}

} // namespace
} // namespace cnem::app
