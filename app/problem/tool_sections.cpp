#include "app/problem/tool_sections.hpp"

#include "app/problem/bodies.hpp"
#include "clouds/generate.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "methods/registry.hpp"

#include <fmt/format.h>
#include <utility>

namespace cnem::app {
namespace {

ToolSection<2> make_section(const input::Case& input, const input::Tool& tool, ToolIndex index,
                            std::vector<std::string>& warnings) {
  const input::ToolNodes& nodes = *tool.section;
  const contact::ToolMetal& metal = *tool.metal;
  const Space space = input.analysis.space();
  clouds::GeneratedCloud generated =
      clouds::generate_cloud({.outer = tool.outline, .holes = {}, .cracks = {}}, nodes.spacing, {});
  for (const std::string& warning : generated.warnings)
    warnings.push_back(fmt::format("tools.{}.heat.section: {}", tool.name, warning));
  ToolSection<2> section;
  section.name = tool.name;
  section.tool = index;
  section.conductance = tool.thermal.conductance;
  section.temperature = tool.thermal.temperature;
  section.cloud = std::move(generated.cloud);
  section.approximation = methods::make<2>("fe-triangles", {.space = space})->rebuild(section.cloud);
  section.conductivity = metal.conductivity;
  section.heat_curves = metal.heat_curves;
  section.coating = nodes.coating;
  section.held = nodes_of(facets_of(section.cloud, nodes.held));
  section.complete(metal.density * metal.specific_heat, nodes.heat_capacity_factor, space);
  return section;
}

} // namespace

std::vector<ToolSection<2>> tool_sections(const input::Case& input, std::vector<std::string>& warnings) {
  std::vector<ToolSection<2>> sections;
  for (std::size_t t = 0; t < input.tools.size(); ++t) {
    const input::Tool& tool = input.tools[t];
    if (!tool.section) continue;
    const std::string at = "tools." + tool.name + ".heat.section";
    try {
      sections.push_back(make_section(input, tool, as<ToolIndex>(t), warnings));
    } catch (const clouds::SpacingError& error) {
      throw input.error(at + ".spacing", error.what());
    } catch (const GeometryError& error) { throw input.error(at, error.what()); }
  }
  return sections;
}

} // namespace cnem::app
