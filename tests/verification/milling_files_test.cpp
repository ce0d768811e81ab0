// What a milling run leaves beside its status: surface, spectra, and the verdict on chatter.
#include "tests/finished_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <tuple>

namespace cnem::testing {
namespace {

/// Runs cases/milling/time_chart at 5000 rpm, where the limit of Floquet is 0.2603 mm.
results::RunStatus milled_at(const std::string& depth, const std::filesystem::path& folder,
                             const std::vector<std::string>& set = {"milling.length=1.6 mm",
                                                                    "dexels.layers=3"}) {
  std::vector<std::string> all = set;
  all.push_back("milling.axial_depth=" + depth);
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/time_chart/case.toml", all);
  EXPECT_EQ(app::run(input, {.output = folder, .force = true, .threads = 1, .version = "test"}), Exit::done);
  return results::read_status(folder);
}

/// Four uneven teeth in titanium, which force vibrations that come back after a turn.
const char* const uneven = R"toml(
[analysis]
type = "milling"
[cutter]
diameter = "16 mm"
teeth = 4
helix = "35 deg"
pitch = "80 95 85 100 deg"
[cutting.forces]
law = "linear"
Ktc = "1650 MPa"
Krc = "480 MPa"
Kte = "24 N/mm"
Kre = "43 N/mm"
[milling]
speed = "2400 rpm"
feed = "0.06 mm"
axial_depth = "1 mm"
radial_depth = "4 mm"
side = "down"
length = "4.8 mm"
start = "inside"
[dexels]
layers = 4
[modes.x1]
frequency = "640 Hz"
damping = 0.03
stiffness = "8 N/um"
direction = "1 0 0"
[modes.x2]
frequency = "1480 Hz"
damping = 0.022
stiffness = "12 N/um"
direction = "1 0 0"
[modes.y1]
frequency = "702 Hz"
damping = 0.028
stiffness = "7.2 N/um"
direction = "0 1 0"
)toml";

results::RunStatus milled(const std::filesystem::path& folder, const std::vector<std::string>& set) {
  std::ofstream(folder / "cut.toml") << uneven;
  const input::Case input = input::read_case((folder / "cut.toml").string(), set);
  EXPECT_EQ(app::run(input, {.output = folder / "results", .force = true, .threads = 1, .version = "test"}),
            Exit::done);
  return results::read_status(folder / "results");
}

} // namespace

TEST(MillingFiles, ThickChipsThatTeethForceAreNoChatter) {
  const TemporaryFolder folder("forced");
  const results::RunStatus cut = milled(folder.path(), {});
  EXPECT_GT(cut.metric("milling.chip_growth").value_or(0.0), 1.25) << "more than Campomanes allows";
  EXPECT_LT(cut.metric("milling.growth").value_or(1.0), 0.9);
  EXPECT_EQ(cut.metric("milling.chatter"), 0.0) << cut.reason;
  EXPECT_NE(cut.reason.find("what the teeth force makes chips 1.3"), std::string::npos) << cut.reason;
  const results::RunStatus deep = milled(folder.path(), {"milling.axial_depth=2.2 mm"});
  EXPECT_EQ(deep.metric("milling.chatter"), 1.0) << deep.reason;
}

// Strongly uneven teeth near a resonance: chips twice as thick, 2% below the limit of Floquet.
TEST(MillingFiles, TwiceAsThickChipsOfUnevenTeethAreForced) {
  const FinishedRun cut = finish(input::read_case_text(R"toml(
analysis = { type = "milling" }
[cutter]
diameter = "16 mm"
teeth = 3
pitch = "112 118 130 deg"
helix = "28 deg"
[cutting.forces]
law = "linear"
Ktc = "850 MPa"
Krc = "260 MPa"
[milling]
speed = "5800 rpm"
feed = "8 um"
axial_depth = "3.002 mm"
radial_depth = "5 mm"
side = "up"
length = "1 mm"
[modes]
x = { frequency = "740 Hz", damping = 0.027, stiffness = "12 N/um", direction = "1 0 0" }
y = { frequency = "905 Hz", damping = 0.022, stiffness = "9 N/um", direction = "0.1 1 0" }
)toml",
                                                       "case.toml", {}));
  EXPECT_GT(cut.metric("milling.chip_growth"), 2.0);
  EXPECT_LT(cut.metric("milling.growth"), 0.95);
  EXPECT_EQ(cut.metric("milling.chatter"), 0.0) << cut.status.reason;
}

// Multipliers of 1.40, 1.42 and 0.95: deep in the unstable, teeth miss the cut, and the vibration comes back
// with each tooth, or collapses and grows anew, so that differences from tooth to tooth shrink over the whole
// of it.
TEST(MillingFiles, ChatterThatTeethLeaveIsChatter) {
  const TemporaryFolder folder("missed");
  for (const auto& [speed, depth, chatters] :
       {std::tuple{"5769 rpm", "1.76 mm", 1.0}, {"5641 rpm", "1.92 mm", 1.0}, {"9000 rpm", "1.5 mm", 0.0}}) {
    const results::RunStatus cut = milled_at(depth, folder.path(), {std::string("milling.speed=") + speed});
    EXPECT_EQ(cut.metric("milling.chatter"), chatters) << speed << ": " << cut.reason;
    EXPECT_LT(cut.metric("milling.growth").value_or(2.0), 1.0) << speed;
  }
}

TEST(MillingFiles, APathThatMissesIsTold) {
  const TemporaryFolder folder("missed");
  const results::RunStatus cut = milled(folder.path(), {"milling.start=outside", "milling.length=0.1 mm"});
  EXPECT_EQ(cut.reason.find("nothing is cut"), 0U) << cut.reason;
  EXPECT_TRUE(std::any_of(cut.warnings.begin(), cut.warnings.end(), [](const std::string& warning) {
    return warning.find("no tooth meets the workpiece") != std::string::npos;
  }));
}

/// Edges that only touch bear their edge forces or do not, from one question to the next: no failure of a
/// cut.
TEST(MillingFiles, EdgesThatOnlyTouchMayRub) {
  const TemporaryFolder folder("touch");
  const results::RunStatus cut =
      milled(folder.path(), {"milling.feed=0.02 mm", "milling.radial_depth=0.1 mm", "milling.length=1.2 mm",
                             "cutting.forces.Kre=120 N/mm", "dexels.steps=360"});
  EXPECT_TRUE(std::any_of(cut.warnings.begin(), cut.warnings.end(), [](const std::string& warning) {
    return warning.find("forces and vibration do not agree in") != std::string::npos;
  }));
}

TEST(MillingFiles, SpectraAndStatusTellChatterFromHarmonics) {
  const TemporaryFolder folder("chatter");
  const results::RunStatus grows = milled_at("0.275 mm", folder.path());
  EXPECT_EQ(grows.metric("milling.chatter"), 1.0);
  EXPECT_GT(grows.metric("milling.growth").value_or(0.0), 1.0);
  const double chatter = grows.metric("milling.chatter_frequency").value_or(0.0);
  EXPECT_NEAR(chatter, 934.0, 12.0) << "a little above the mode's 922 Hz";
  const results::HistoryTable spectra = results::read_history(folder.path() / results::files::spectra);
  const auto column = [&](const char* name) {
    return spectra.column.at(static_cast<std::size_t>(spectra.find(name)));
  };
  const std::vector<double> frequency = column("frequency"), harmonic = column("harmonic"), x = column("x");
  const double tooth = grows.metric("milling.tooth_frequency").value_or(0.0);
  EXPECT_NEAR(tooth, 2.0 * 5000.0 / 60.0, 1e-9);
  double strongest = 0.0, at = 0.0;
  for (std::size_t k = 1; k < frequency.size(); ++k) {
    const double multiple = frequency[k] / tooth, turn = 2.0 * multiple;
    EXPECT_EQ(harmonic[k], std::abs(multiple - std::round(multiple)) < 1e-6 ? 2.0
                           : std::abs(turn - std::round(turn)) < 1e-6       ? 1.0
                                                                            : 0.0)
        << frequency[k];
    if (harmonic[k] == 0.0 && x[k] > strongest) strongest = x[k], at = frequency[k];
  }
  EXPECT_NEAR(at, chatter, 1.5 * frequency[1]) << "the strongest line that is no harmonic";

  const results::RunStatus decays = milled_at("0.25 mm", folder.path());
  EXPECT_EQ(decays.metric("milling.chatter"), 0.0);
  EXPECT_LT(decays.metric("milling.growth").value_or(2.0), 1.0);
  EXPECT_FALSE(decays.metric("milling.chatter_frequency"));
}

TEST(MillingFiles, SurfaceIsAGridOfWhatIsLeft) {
  const TemporaryFolder folder("surface");
  milled_at("0.1 mm", folder.path());
  const results::HistoryTable surface =
      results::read_history(folder.path() / results::files::machined_surface);
  ASSERT_EQ(surface.column.size(), 4U) << "x and three layers";
  std::ifstream file(folder.path() / results::files::machined_surface_grid);
  std::stringstream text;
  text << file.rdbuf();
  const std::string grid = text.str();
  std::istringstream points(grid.substr(grid.find("double\n") + 7));
  for (std::size_t layer = 1; layer <= 3; ++layer)
    for (std::size_t row = 0; row < surface.rows(); ++row) {
      double px = 0.0, py = 0.0, pz = 0.0;
      ASSERT_TRUE(points >> px >> py >> pz);
      EXPECT_NEAR(px, surface.column[0][row], 1e-9);
      EXPECT_NEAR(py, 6e-3 - surface.column[layer][row], 1e-10) << "up-milling leaves the +y side";
      EXPECT_NEAR(pz, 0.1e-3 * (static_cast<double>(layer) - 0.5) / 3.0, 1e-9);
    }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / results::files::pictures_folder / "surface_000.png"));
}

// Scallops of a ball end in up-milling are parabolas of f²/8(r + f/2π) (one tooth) at a radius r = R sin κ,
// of which Ra is 0.2566; over the height, dz = R sin κ dκ. Layers are thin near the tip, where scallops are
// high: a mean over layers alike would be two thirds more.
TEST(MillingFiles, RoughnessIsAMeanOverTheHeight) {
  constexpr double R = 6e-3, f = 0.4e-3, depth = 3e-3;
  const FinishedRun run =
      finish(input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/end_mill_forces/case.toml",
                              {"cutter.end=ball", "cutter.helix=0 deg", "cutter.teeth=1", "milling.side=up",
                               "milling.radial_depth=6 mm", "milling.axial_depth=3 mm", "milling.feed=0.4 mm",
                               "milling.length=3.2 mm", "dexels.steps=2880"}));
  constexpr int pieces = 1000;
  const double top = std::acos(1.0 - depth / R), way = f / (2.0 * std::numbers::pi);
  double mean = 0.0; // of 1/(r + f/2π) over the height
  for (int i = 0; i < pieces; ++i) {
    const double sine = std::sin((i + 0.5) * top / pieces);
    mean += R * sine / (R * sine + way) * top / pieces / depth;
  }
  const double exact = 0.2566 * f * f / 8.0 * mean;
  EXPECT_NEAR(run.metric("milling.Ra") / exact, 1.0, 0.06);
}

} // namespace cnem::testing
