// Adaptation together with what follows nodes: lines of material points.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

const std::string with_line = punched_block + R"toml(
[time]
end = "6 us"
[output]
pictures = []
[output.lines.middle]
from = "0 1.2 mm"
to = "4 1.2 mm"
fields = ["displacement_x", "displacement_y"]
)toml";

results::HistoryTable middle_of(const std::vector<std::string>& set) {
  const TemporaryFolder folder("lines");
  const input::Case input = input::read_case_text(with_line, "case.toml", set);
  EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .version = "test"}), Exit::done);
  return results::read_history(folder.path() / "lines" / "middle.csv");
}

TEST(AdaptedFeatures, lines_are_of_the_same_matter_as_without_adaptation) {
  const results::HistoryTable still = middle_of({"cloud.spacing=\"0.1 mm\""});
  const results::HistoryTable adapted = middle_of({"adapt.resample=true", "adapt.tool_spacing=\"0.1 mm\""});
  ASSERT_EQ(adapted.rows(), still.rows());
  for (const char* name : {"x", "y", "distance"}) // where the points were at time 0
    EXPECT_EQ(adapted.column[std::size_t(adapted.find(name))], still.column[std::size_t(still.find(name))]);
  double largest = 0.0;
  for (const char* name : {"displacement_x", "displacement_y"})
    for (const double u : still.column[std::size_t(still.find(name))])
      largest = std::max(largest, std::abs(u));
  EXPECT_GT(largest, 0.1e-3);
  for (const char* name : {"displacement_x", "displacement_y"})
    for (std::size_t k = 0; k < still.rows(); ++k)
      EXPECT_NEAR(adapted.column[std::size_t(adapted.find(name))][k],
                  still.column[std::size_t(still.find(name))][k], 0.05 * largest)
          << name << " at sample " << k;
}

} // namespace
} // namespace cnem::testing
