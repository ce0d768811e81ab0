// What a run will take, and a case in plain words.
#include "tests/unit/app/forecast_fixture.hpp"

#include "app/command_line.hpp"
#include "app/explain.hpp"
#include "input/case_reader.hpp"
#include "tests/shared_cases.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

const std::string& cut = testing::aluminium_cut;

const std::string heat = "heat = { specific_heat = \"900 J/(kg K)\", conductivity = \"120 W/(m K)\" }\n";

input::Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return input::read_case_text(text, "case.toml", overrides);
}

TEST(Forecast, OfAWindowIsOfAsManyNodesForAnyLength) {
  const auto in_window = [](const std::string& length) {
    return read(cut, {"cutting.window=true", "cutting.length=" + length});
  };
  const Forecast expected = expected_of(in_window("3 mm"));
  EXPECT_GT(expected.nodes_last, 1.2 * expected.nodes_first);
  EXPECT_EQ(expected.nodes_last, expected_of(in_window("30 mm")).nodes_last);
  EXPECT_NE(explanation(in_window("3 mm"))
                .find("goes with the tool: 3.6 mm ahead of it, 2.4 mm behind, 4.5 mm of chip"),
            std::string::npos);
}

TEST(Forecast, FitsTheRunOfACut) {
  expect_that_it_fits_its_run(read(cut, {"output.pictures=[]", "cutting.length=0.2 mm"}));
}

// In space cells get smaller as the tool goes on than those that its first step is of.
TEST(Forecast, FitsTheRunOfAnObliqueCut) {
  const std::string path = std::string(CNEM_SOURCE_DIR) + "/cases/three_dimensions/oblique_cutting/case.toml";
  const auto to = [&](const std::string& length, const std::vector<std::string>& more = {}) {
    std::vector<std::string> set{"let.length=" + length, "output.pictures=[]"};
    set.insert(set.end(), more.begin(), more.end());
    return input::read_case(path, set);
  };
  expect_that_it_fits_its_run<3>(to("0.15 mm"));
  const Forecast brief = expected_of<3>(to("0.15 mm")), longer = expected_of<3>(to("0.3 mm"));
  EXPECT_GT(longer.steps, 2.2 * brief.steps);
  EXPECT_LT(expected_of<3>(to("0.15 mm", {"adapt.resample=false"})).steps, 0.8 * brief.steps);
}

TEST(Forecast, CountsWithWhatRefines) {
  const std::string light = "time.mass_scaling.factor=1", fine = "adapt.tool_spacing=5 um";
  const Forecast plain = expected_of(read(cut, {light, "adapt.tool_spacing=15 um"})),
                 finer = expected_of(read(cut, {light, fine})),
                 heavier = expected_of(read(cut, {"time.mass_scaling.cell=15 um", fine})),
                 longer = expected_of(read(cut, {"adapt.rest_factor=0", "cutting.length=0.6 mm"})),
                 surface =
                     expected_of(read(cut, {"adapt.indicator.field=none", "adapt.surface_spacing=4 um"})),
                 none = expected_of(read(cut, {"adapt.indicator.field=none", "adapt.surface_spacing=60 um"})),
                 coarse = expected_of(read(cut, {"adapt.resample=false"}));
  EXPECT_NEAR(finer.steps, 3.0 * plain.steps, 0.01 * finer.steps) << "cells of 5 µm for 15";
  EXPECT_LT(heavier.steps, 0.5 * finer.steps) << "they take the step of wider ones";
  EXPECT_GT(finer.nodes_first, plain.nodes_first);
  EXPECT_EQ(plain.nodes_last, plain.nodes_first) << "what rests is made coarse";
  EXPECT_GT(longer.nodes_last, plain.nodes_last + 100.0) << "the chip keeps its cells";
  EXPECT_EQ(surface.finest, 4e-6);
  EXPECT_GT(surface.nodes_first, none.nodes_first + 100.0);
  EXPECT_LT(coarse.steps, 0.3 * plain.steps);
  EXPECT_EQ(coarse.nodes_first, coarse.nodes_last);
}

TEST(Explain, SaysWhatDecidesAboutACut) {
  const std::string text = explanation(read(cut + heat));
  const double peclet = (1600.0 / 60.0) * 3e-4 * 2700.0 * 900.0 / 120.0;
  const double share = 0.5 * 2700.0 * std::pow(1600.0 / 60.0, 2) / 440e6;
  for (const std::string& part :
       {fmt::format("= {:.3g}: it goes with the chip", peclet), std::string("r/f = 0.2: honed"),
        fmt::format("= {:.2g}: forces are those of a slow cut", share), std::string("20 over the feed"),
        std::string("25 along the arc"), std::string("cutter moves at 26.67 m/s"),
        std::string("steps       about ")})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  EXPECT_EQ(explanation(read(cut)).find("Péclet"), std::string::npos) << "without heat";
  const std::string heavy = explanation(read(cut, {"time.mass_scaling.factor=100"}));
  EXPECT_NE(heavy.find(fmt::format("= {:.2g}: it acts on the forces", 100.0 * share)), std::string::npos)
      << heavy;
}

TEST(Explain, SaysThatACutIsLong) {
  const auto note = [](const std::vector<std::string>& overrides) {
    return explanation(read(cut, overrides)).find("--set cutting.length=\"3 mm\"") != std::string::npos;
  };
  EXPECT_TRUE(note({"cutting.length=200 mm"}));
  EXPECT_FALSE(note({}));
  EXPECT_NE(explanation(read(cut, {"time.end=1 ms"})).find("beyond the length of cut"), std::string::npos);
}

TEST(Explain, SaysThatASlowCutMayBeHeavier) {
  const auto note = [](const std::vector<std::string>& overrides) {
    return explanation(read(cut, overrides)).find("--set time.mass_scaling.factor=400") != std::string::npos;
  };
  EXPECT_TRUE(note({"cutting.speed=10 m/min", "cutting.length=3 mm"}));
  EXPECT_FALSE(note({"cutting.speed=10 m/min", "cutting.length=3 mm", "time.mass_scaling.factor=400"}));
  EXPECT_FALSE(note({"cutting.length=200 mm"})) << "inertia would act";
}

TEST(Explain, SaysWhatOtherCasesAre) {
  const std::string text = explanation(read(testing::pulled_block));
  EXPECT_NE(text.find("4 mm x 2 mm in the plane, steel"), std::string::npos) << text;
  EXPECT_NE(text.find("of equilibrium"), std::string::npos) << text;
  const std::string round = explanation(
      read(testing::pulled_block,
           {"domain.outer={ circle = { centre = \"1 1 mm\", radius = \"1 mm\", name = \"bottom\" } }",
            "boundary.top={ pieces = \"bottom\", pressure = \"1 MPa\" }"}));
  EXPECT_NE(round.find("2 mm x 2 mm in the plane"), std::string::npos) << round;
}

} // namespace
} // namespace cnem::app
