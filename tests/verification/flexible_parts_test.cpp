// Parts that move or deform while a tool takes matter from them (paper 004, section 3).
#include "tests/finished_run.hpp"

#include "results/checkpoint_folder.hpp"

#include <fmt/format.h>
#include <fstream>
#include <map>
#include <sstream>

namespace cnem::testing {
namespace {

input::Case milling_case(const std::string& name, const std::vector<std::string>& set) {
  return input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/" + name + "/case.toml", set);
}

} // namespace

TEST(PlateRemoval, InterpolatedInversesComeNearerWithShorterIntervals) { // a tenth of Table 2's run
  const auto run = [](const std::string& inverse, int interval) {
    return finish(milling_case("plate_removal", {"removal.duration=10 ms", "removal.inverse=" + inverse,
                                                 "removal.interval=" + std::to_string(interval)}));
  };
  const FinishedRun coarse = run("interpolated", 500), fine = run("interpolated", 100),
                    printed = run("interpolated-common", 100);
  EXPECT_NEAR(fine.metric("removal.begin.f1"), 3342.677, 1e-3);
  EXPECT_LT(fine.metric("removal.P.deviation"), 2.6e-3);
  EXPECT_LT(2.0 * fine.metric("removal.P.deviation"), coarse.metric("removal.P.deviation"));
  EXPECT_GT(printed.metric("removal.P.deviation"), 3.0 * fine.metric("removal.P.deviation"));
  EXPECT_GT(fine.metric("removal.energy.chips"), 0.0);
  EXPECT_LT(std::abs(fine.metric("removal.energy.imbalance")), 0.05 * fine.metric("removal.energy.work"));
  EXPECT_NEAR(fine.of("tool").back(), 0.01, 1e-9);
}

TEST(FlexibleParts, MappedWhereTheyMoveAlikeAreThatOfOnePlace) { // midway along the wall, its first mode
  const auto run = [](const std::string& mapping) {
    return finish(milling_case("thin_part", {"analysis.type=milling", "part.cutter=48 40 4 mm",
                                             "part.count=1", "part.mapping=" + mapping}));
  };
  const FinishedRun point = run("point"), mapped = run("hexahedra");
  EXPECT_GT(point.metric("milling.displacement"), 4e-6);
  for (const char* force : {"milling.Fx", "milling.Fy", "milling.power"})
    EXPECT_NEAR(mapped.metric(force) / point.metric(force), 1.0, 2e-3) << force;
  EXPECT_NEAR(mapped.metric("milling.location_error") / point.metric("milling.location_error"), 1.0, 0.03);
  for (const char* energy : {"energy.kinetic", "energy.elastic", "energy.damping"})
    EXPECT_GT(mapped.of(energy).back(), 0.0) << energy;
  EXPECT_EQ(mapped.of("energy.chips").back(), 0.0); // its modes stay what they are
  EXPECT_LT(std::abs(mapped.of("energy.residual").back()), 1e-3 * mapped.of("energy.spindle").back());
  EXPECT_NEAR(mapped.metric("milling.part.end.f1") / mapped.metric("milling.part.begin.f1"), 1.0, 1e-12);
}

TEST(FlexibleParts, LoseWhatARigidRunTakes) {
  const FinishedRun done =
      finish(milling_case("wall_removal", {"milling.length=12 mm", "part.removal.interval=300"}));
  // Matter goes at the free edge: the wall swings faster.
  EXPECT_GT(done.metric("milling.part.end.f1"), 1.0005 * done.metric("milling.part.begin.f1"));
  EXPECT_LT(done.metric("milling.part.end.f1"), 1.02 * done.metric("milling.part.begin.f1"));
  EXPECT_GT(done.metric("milling.displacement"), 1e-6);
}

TEST(FlexibleParts, EndWhereHexahedraFoldAndLeaveTheLastGoodStep) {
  const input::Case input = milling_case("flexible_wall", {"part.young=2 MPa", "part.density=100 kg/m3",
                                                           "milling.length=12 mm", "dexels.layers=9"});
  const TemporaryFolder folder("folds");
  EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::diverged);
  const results::RunStatus status = results::read_status(folder.path());
  EXPECT_NE(status.reason.find("hexahedron ("), std::string::npos) << status.reason;
  EXPECT_NE(status.reason.find("step "), std::string::npos) << status.reason;
  EXPECT_FALSE(results::list_checkpoints(folder.path()).empty());
}

TEST(FlexibleParts, LedgerAddsUpWhileTheyLoseMatter) { // cutting, held, damped and what leaves with chips
  std::vector<double> residual;
  for (const int steps : {360, 720}) {
    const FinishedRun done = finish(milling_case(
        "wall_removal", {"milling.length=4.5 mm", "part.removal.interval=60",
                         "dexels.steps=" + std::to_string(steps), "part.rayleigh.stiffness=2 us"}));
    for (const char* energy : {"chips", "damping", "kinetic", "elastic"})
      EXPECT_GT(done.metric(std::string("milling.energy.") + energy), 0.0) << energy;
    residual.push_back(done.status.energy_residual);
  }
  EXPECT_LT(residual[0], 3e-5); // the part alone takes 6e-3
  EXPECT_LT(residual[1], 0.5 * residual[0]);
}

namespace {

constexpr const char* stepped_wall = R"toml(
[part]
size = "100 40 4 mm"
cells = "10 4 1"
element = "plate_8"
young = "200 GPa"
density = "7800 kg/m3"
clamped = ["y0"]
damping = 0.01
cutter = "0 40 2 mm"
axis = "0 1 0"
)toml";

constexpr const char* lobes_along_it = R"toml(
[analysis]
type = "stability"
[cutter]
diameter = "12 mm"
teeth = 3
[cutting.forces]
law = "linear"
Ktc = "600 MPa"
[milling]
speed = "8000 rpm"
feed = "0.1 mm"
axial_depth = "1 mm"
radial_depth = "1 mm"
[part.zones.stock]
from = "0 20 2 mm"
to = "100 40 4 mm"
[stability]
places = "0 20 50 100 mm"
takes = "stock"
speeds = 3
depths = 4
)toml";

/// Frequency, Hz, and stiffness, N/m, of "mode at place" in a modes.csv that holds modes of a part alone.
std::map<std::string, std::pair<double, double>> modes_in(const std::filesystem::path& folder) {
  std::map<std::string, std::pair<double, double>> met;
  std::ifstream file(folder / results::files::modes);
  std::string row;
  std::getline(file, row);
  while (std::getline(file, row)) {
    std::vector<std::string> cell;
    std::istringstream cells(row);
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    EXPECT_EQ(cell.size(), 10U) << row;
    EXPECT_EQ(cell[0], "part");
    met[cell.at(1) + " at " + cell.at(4)] = {std::stod(cell.at(2)), std::stod(cell.at(5))};
  }
  return met;
}

} // namespace

TEST(PartsAlongAPath, ModesAreThoseOfWhatTheCutterHasLeft) {
  const TemporaryFolder folder("lobes");
  const input::Case lobes =
      input::read_case_text(std::string(stepped_wall) + lobes_along_it, "case.toml", {});
  ASSERT_EQ(app::run(lobes, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  const auto met = modes_in(folder.path());
  EXPECT_EQ(met.size(), 4U * 6U);
  for (const int place : {20, 50, 100}) { // analysis.type = "modes" of the same state
    const TemporaryFolder beside("modes");
    const input::Case modes = input::read_case_text(std::string(stepped_wall) + fmt::format(R"toml(
[analysis]
type = "modes"
[part.zones.gone]
from = "0 20 2 mm"
to = "{0} 40 4 mm"
taken = 0.999
[part.points.P]
at = "{0} 40 2 mm"
)toml",
                                                                                            place),
                                                    "case.toml", {});
    ASSERT_EQ(app::run(modes, {.output = beside.path(), .force = true, .threads = 1, .version = "test"}),
              Exit::done);
    const results::RunStatus left = results::read_status(beside.path());
    for (int mode = 1; mode <= 6; ++mode) {
      const auto& [frequency, stiffness] = met.at(fmt::format("{} at {}", mode, 1e-3 * place));
      EXPECT_NEAR(frequency / left.metric(fmt::format("modes.part.f{}", mode)).value(), 1.0, 1e-6) << place;
      EXPECT_NEAR(stiffness / left.metric(fmt::format("modes.part.P.k{}", mode)).value(), 1.0, 1e-6) << place;
    }
  }
  EXPECT_LT(met.at("1 at 0.1").second, met.at("1 at 0").second);
}

TEST(PartModes, ThatDoNotMoveAFaceHaveNoStiffnessThere) { // torsion of a plate, at its free end
  const TemporaryFolder folder("torsion");
  const input::Case plate = input::read_case_text(R"toml(
[analysis]
type = "modes"
[part]
size = "90 55 5 mm"
cells = "11 7 2"
young = "71 GPa"
poisson = 0.33
density = "2800 kg/m3"
clamped = ["y0"]
count = 2
[part.points.end]
face = "y1"
)toml",
                                                  "case.toml", {});
  ASSERT_EQ(app::run(plate, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  const results::RunStatus modes = results::read_status(folder.path());
  EXPECT_TRUE(modes.metric("modes.part.f2"));
  EXPECT_TRUE(modes.metric("modes.part.end.k1"));
  EXPECT_FALSE(modes.metric("modes.part.end.k2"));
}

TEST(PartsAlongAPath, ModesKeepTheirNumbersWhereOthersHaveNodes) { // midway along the wall
  const auto met = [](const std::string& rest, const std::vector<std::string>& set) {
    const TemporaryFolder folder("numbers");
    const input::Case input = input::read_case_text(std::string(stepped_wall) + rest, "case.toml", set);
    EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .threads = 1, .version = "test"}),
              Exit::done);
    return modes_in(folder.path());
  };
  const auto lobes = // of the whole wall: what is taken begins behind that place
      met(lobes_along_it, {"stability.places=50 mm", "part.zones.stock.from=60 20 2 mm"});
  const auto modes = met(R"toml(
[analysis]
type = "modes"
[part.points.P]
at = "50 40 2 mm"
)toml",
                         {});
  ASSERT_LT(lobes.size(), 6U) << "some have nodes there";
  ASSERT_EQ(lobes.size(), modes.size());
  for (const auto& [name, mode] : lobes) {
    const std::string number = name.substr(0, name.find(' '));
    EXPECT_NEAR(mode.first / modes.at(number + " at P").first, 1.0, 1e-6) << number;
    EXPECT_NEAR(mode.second / modes.at(number + " at P").second, 1.0, 1e-6) << number;
  }
}

} // namespace cnem::testing
