// An elastic sphere pressed on a rigid plane, slowly, against Hertz.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cnem::testing {
namespace {

// Five spacings over the radius of the contact, twice as fast as the case is run.
TEST(Hertz, force_over_approach_is_within_3_percent) {
  const TemporaryFolder temporary{"hertz"};
  const input::Case input = input::read_case(
      CNEM_SOURCE_DIR "/cases/three_dimensions/hertz/case.toml",
      {"cloud.refine.contact.spacing=0.1 mm", "time.end=25 us", "tools.plane.velocity.z.value=-1.12 m/s",
       "tools.plane.velocity.z.ramp=5 us", "output.pictures=[]", "output.fields_every=25 us"});
  ASSERT_EQ(app::run(input, {.output = temporary.path(), .force = true, .version = "test"}), Exit::done);
  const results::HistoryTable history = results::read_history(temporary.path() / "history.csv");
  const auto column = [&](const char* name) -> const std::vector<double>& {
    return history.column[index_of(history.find(name))];
  };
  const auto &force = column("plane.force_z[N]"), &way = column("plane.displacement_z[m]");
  constexpr double young = 210e9, poisson = 0.3, radius = 10e-3;
  int rows = 0;
  for (std::size_t k = 0; k < force.size(); ++k) {
    const double d = std::abs(way[k]);
    if (d < 0.0205e-3) continue; // contacts of 4.5 spacings and more
    const double hertz = 4.0 / 3.0 * young / (1.0 - poisson * poisson) * std::sqrt(radius * d * d * d);
    EXPECT_NEAR(4.0 * std::abs(force[k]), hertz, 0.03 * hertz) << "d = " << d;
    ++rows;
  }
  EXPECT_GT(rows, 5);
}

} // namespace
} // namespace cnem::testing
