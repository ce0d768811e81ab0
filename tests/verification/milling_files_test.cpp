// What a milling run leaves beside its status: surface, spectra, and the verdict on chatter.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace cnem::testing {
namespace {

/// Runs cases/milling/time_chart at 5000 rpm, where the limit of Floquet is 0.2603 mm.
results::RunStatus milled_at(const std::string& depth, const std::filesystem::path& folder) {
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/milling/time_chart/case.toml",
                       {"milling.axial_depth=" + depth, "milling.length=1.6 mm", "dexels.layers=3"});
  EXPECT_EQ(app::run(input, {.output = folder, .force = true, .threads = 1, .version = "test"}), Exit::done);
  return results::read_status(folder);
}

} // namespace

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

} // namespace cnem::testing
