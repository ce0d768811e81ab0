// Isotherms of linear temperatures in a tool.
#include "evaluate/tool_isotherms.hpp"

#include "app/problem/registry.hpp"
#include "core/index.hpp"
#include "input/case_reader.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::evaluate {
namespace {

constexpr const char* cut_text = R"toml(
[time]
end = "1 us"
[domain]
material = "metal"
outer.rectangle = { from = "0 0 mm", to = "3 1 mm" }
[cloud]
spacing = "0.2 mm"
[materials.metal]
density = "8000 kg/m3"
elastic = { young = "200 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "1 GPa" }
heat = { specific_heat = "500 J/(kg K)", conductivity = "20 W/(m K)" }
[tools.cutter]
rectangle = { from = "-1 0.5 mm", to = "0 2.5 mm" }
velocity = "10 0 m/s"
[tools.cutter.heat]
conductivity = "80 W/(m K)"
density = "15000 kg/m3"
specific_heat = "200 J/(kg K)"
section.spacing = "0.15 mm"
)toml";

TEST(Isotherms, of_a_linear_temperature_are_straight) {
  const input::Case input = input::read_case_text(cut_text, "cut.toml");
  const input::CuttingTool cut = input::cutting_tool(input, 0);
  const ToolSection<2> section = app::build<2>(input).problem.tool_sections.front();
  Field temperature; // 400 K/mm below the rake face, 200 K/mm along it
  for (const Vec2& x : section.cloud.position)
    temperature.push_back(1040.0 + 4e5 * x.x() - 2e5 * (x.y() - 5e-4));
  const std::vector<double> at{800.0, 500.0, 1100.0};
  const std::vector<Isotherm> lines = tool_isotherms(section, temperature, cut, at);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NEAR(lines[0].depth, 6e-4, 1e-9);
  EXPECT_NEAR(lines[0].face_from, 0.0, 1e-9);
  EXPECT_NEAR(lines[0].face_to, 1.2e-3, 1e-9);
  EXPECT_NEAR(lines[1].depth, 1e-3, 1e-9) << "through the tool";
  EXPECT_NEAR(lines[1].face_to, 2e-3, 1e-9) << "all of the face";
  EXPECT_TRUE(std::isnan(lines[2].depth));
  EXPECT_TRUE(std::isnan(lines[2].face_to));
  EXPECT_EQ(round_temperatures(temperature), (std::vector<double>{300, 400, 500, 600, 700, 800, 900, 1000}));
}

} // namespace
} // namespace cnem::evaluate
