// What there is to doubt in milling cases.
#include "app/run.hpp"
#include "input/case_machining.hpp"
#include "input/case_reader.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace cnem::app {
namespace {

std::vector<std::string> doubts_of_lobes(std::vector<std::string> set) {
  set.insert(set.end(), {"cutting.flank.land=60 um", "cutting.flank.recovery=1 um",
                         "cutting.flank.specific_force=40 kN/mm^3", "cutting.flank.friction=0.3"});
  return check(input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/wall_lobes/case.toml", set),
               {})
      .warnings;
}

bool tell_of_waves(const std::vector<std::string>& doubts) {
  return std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
    return doubt.find("mode wall of the part leaves waves") != std::string::npos;
  });
}

// A land of 60 um is longer than a radian of the wave of 2000 Hz below 1200 rpm.
TEST(MillingDoubts, FlanksAreComparedWithTheFastestModeAlongThePath) {
  EXPECT_FALSE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1300 rpm"})));
  EXPECT_TRUE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1100 rpm"})));
  // Where it is looked at, it is slower by a fifth.
  EXPECT_FALSE(tell_of_waves(doubts_of_lobes({"stability.speed_from=1100 rpm", "stability.places=100 mm"})));
  EXPECT_TRUE(tell_of_waves(
      doubts_of_lobes({"stability.speed_from=1300 rpm", "modes.wall.frequency_along=1 0.97 1.2 0.84 0.8"})));
}

const std::string end_mill = std::string(CNEM_SOURCE_DIR) + "/cases/milling/end_mill_forces/case.toml";

// Dexels know what a tooth leaves that misses the cut; lobes do not.
TEST(MillingDoubts, TeethThatMissTheCutAreTheBusinessOfLobes) {
  const auto told = [](const char* type) {
    const auto doubts =
        check(input::read_case(end_mill, {std::string("analysis.type=") + type, "cutter.run_out=60 um",
                                          "modes.y.frequency=900 Hz", "modes.y.damping=0.03",
                                          "modes.y.stiffness=10 N/um", "modes.y.direction=0 1 0"}),
              {})
            .warnings;
    return std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
      return doubt.find("a tooth misses the cut") != std::string::npos;
    });
  };
  EXPECT_TRUE(told("stability"));
  EXPECT_FALSE(told("milling"));
}

// Displacements under a force at a point of a solid do not converge (Boussinesq).
TEST(MillingDoubts, ForcesAtPointsOfSolidsAreTold) {
  const auto doubts = [](const std::string& element, const std::string& where) {
    return check(input::read_case_text("[analysis]\ntype = \"modes\"\n[part]\nsize = \"100 40 4 mm\"\n"
                                       "young = \"200 GPa\"\ndensity = \"7800 kg/m3\"\nclamped = [\"y0\"]\n"
                                       "element = \"" +
                                           element + "\"\n[part.points.P]\nforce = \"0 0 1 N\"\n" + where,
                                       "case.toml", {}),
                 {})
        .warnings.size();
  };
  EXPECT_EQ(doubts("hexahedron_27", "at = \"100 40 4 mm\""), 1U);
  EXPECT_EQ(doubts("hexahedron_27", "face = \"y1\""), 0U);
  EXPECT_EQ(doubts("plate_8", "at = \"100 40 4 mm\""), 0U);
}

// An edge of 6 mm with a helix of 30 deg on a radius of 6 mm lags by 33.08 deg.
TEST(MillingDoubts, LayersLagByAStepAtMost) {
  const auto layers = [](const char* steps) {
    const std::string path = std::string(CNEM_SOURCE_DIR) + "/cases/milling/benchmark_lobes/case.toml";
    return input::read_case(path, {"analysis.type=milling", "cutter.helix=30 deg", "milling.axial_depth=6 mm",
                                   std::string("dexels.steps=") + steps})
        .machining->dexels.layers;
  };
  EXPECT_EQ(layers("720"), 67);
  EXPECT_EQ(layers("360"), 34);
  EXPECT_EQ(layers("180"), 34);  // a degree at most
  EXPECT_EQ(layers("2880"), 67); // half a degree will do
}

TEST(MillingDoubts, LayersOfABallAreOfWhereItsEdgesEnter) {
  const std::string path = std::string(CNEM_SOURCE_DIR) + "/cases/milling/benchmark_lobes/case.toml";
  const auto read = [&](const char* end) {
    return *input::read_case(path, {"analysis.type=milling", "cutter.helix=30 deg", "cutter.diameter=12 mm",
                                    "milling.axial_depth=1 mm", "milling.radial_depth=3 mm",
                                    std::string("cutter.end=") + end})
                .machining;
  };
  EXPECT_EQ(read("flat").dexels.layers, 12); // 5.51 degrees of lag
  // They enter at acos(3/r), from 0 to 25.2 degrees on the ball up to r = 3.317 mm, and lag by 3.8 there.
  EXPECT_EQ(read("ball").dexels.layers,
            66); // and below 0.804 mm, where they do not enter, pass a twentieth each
}

// A ball of 6 mm, 1 mm deep, reaches 3.317 mm from its axis.
TEST(MillingDoubts, ABallIsToldByTheEdgesThatCut) {
  const input::Case ball =
      input::read_case(end_mill, {"cutter.end=ball", "milling.axial_depth=1 mm", "dexels.layers=1"});
  std::string speed;
  for (const auto& [label, text] : check(ball, {}).facts)
    if (label == "speed") speed = text;
  EXPECT_NE(speed.find("edges move at 2.779 m/s"), std::string::npos) << speed;
}

// An edge whose radius is a little off half of the diameter that is written cuts slots as wide as itself.
TEST(MillingDoubts, ASlotOfARakeFaceIsThatOfItsEdge) {
  const std::string path = std::string(CNEM_SOURCE_DIR) + "/tests/bad_input/milling_rake_face_too_short.toml";
  for (const char* unit : {"0.9995 mm", "1.0005 mm"})
    for (const char* depth : {"", "milling.radial_depth=12 mm"}) {
      std::vector<std::string> set{"milling.axial_depth=4 mm", std::string("cutter.rake_face.unit=") + unit};
      if (*depth) set.emplace_back(depth);
      const machining::MillingCut cut = input::read_case(path, set).machining->cut;
      EXPECT_NEAR(cut.cutter.diameter, 12e-3, 7e-6);
      EXPECT_NE(cut.cutter.diameter, 12e-3);
      EXPECT_EQ(cut.engagement.radial_depth, cut.cutter.diameter) << unit << ' ' << depth;
    }
}

// The face of the file is 5 mm high, in a workpiece of 8 mm.
TEST(MillingDoubts, PassesBelowMatterOverTheirEdgesAreTold) {
  const cnem::testing::TemporaryFolder folder("rake_face_below_matter");
  std::filesystem::copy_file(std::string(CNEM_SOURCE_DIR) + "/tests/bad_input/milling_rake_face.stl",
                             folder.path() / "face.stl");
  const auto told = [&](const std::vector<const char*>& tips) {
    std::ofstream file(folder.path() / "case.toml");
    file << R"toml(
[analysis]
type = "milling"
[cutter]
diameter = "12 mm"
teeth = 3
rake_face = { file = "face.stl" }
[cutting.forces]
law = "linear"
Ktc = "600 MPa"
[milling]
speed = "8000 rpm"
feed = "0.1 mm"
axial_depth = "4 mm"
workpiece = { from = "0 -10 mm", to = "40 0 mm", height = "8 mm" }
)toml";
    for (const char* tip : tips)
      file << "[[milling.passes]]\nstart = \"-8 5 mm\"\npath = [{ to = \"48 5 mm\" }]\ntip = \"" << tip
           << "\"\n";
    file.close();
    std::vector<std::string> found;
    for (const std::string& doubt :
         check(input::read_case((folder.path() / "case.toml").string()), {}).warnings)
      if (doubt.find("edges end 5 mm over the tip") != std::string::npos) found.push_back(doubt);
    return found;
  };
  EXPECT_TRUE(told({"4 mm", "0 mm"}).empty());
  EXPECT_TRUE(told({"3.5 mm", "4 mm", "0 mm"}).empty());
  const std::vector<std::string> low = told({"4 mm", "0 mm", "1 mm"}), first = told({"0 mm", "4 mm"});
  EXPECT_TRUE(low.empty());
  ASSERT_EQ(first.size(), 1U);
  EXPECT_NE(first[0].find("in pass 1 matter lies up to 8 mm over it"), std::string::npos) << first[0];
}

} // namespace
} // namespace cnem::app
