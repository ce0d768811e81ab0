// The thermal side of tools, of the case reader.
#include "input/case_parts.hpp"
#include "input/constants.hpp"
#include "input/curve_checks.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace cnem::input {
namespace {

void check_held(const Setting& held, const Curve& outline, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const CurvePiece& piece : outline.pieces)
    if (std::find(names.begin(), names.end(), piece.name) == names.end()) names.push_back(piece.name);
  const auto& wanted = std::get<std::vector<std::string>>(held.value);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (std::find(names.begin(), names.end(), wanted[i]) == names.end())
      diagnostics.add(Mistake::reference, held.where_of(i), held.path,
                      fmt::format("found {}, expected a piece of the outline: {}{}",
                                  toml_quoted(shortened(wanted[i])), fmt::join(names, ", "),
                                  did_you_mean(wanted[i], names)));
}

ToolNodes read_section(const Setting& table, const Setting& root, const Curve& outline,
                       Diagnostics& diagnostics) {
  ToolNodes section;
  section.spacing.spacing = table.get<double>("spacing");
  for (const Setting& refinement : table.entries("refine"))
    for (clouds::Refinement& region : read_refinement(root, refinement, section.spacing.spacing, diagnostics))
      section.spacing.refinements.push_back(std::move(region));
  section.heat_capacity_factor = table.get<double>("heat_capacity_factor");
  if (const Setting* held = table.find("held")) {
    section.held = std::get<std::vector<std::string>>(held->value);
    if (!outline.pieces.empty()) check_held(*held, outline, diagnostics);
  }
  if (const Setting* coating = table.find("coating"))
    read_constants(ToolCoating::parameters, *coating, section.coating.emplace());
  if (const double size = extent(outline); size > 0.0 && section.spacing.spacing > size)
    diagnostics.add(Mistake::range, table.find("spacing")->where, table.find("spacing")->path,
                    fmt::format("found {:g} m, expected less than the size of the tool, {:.3g} m",
                                section.spacing.spacing, size));
  return section;
}

} // namespace

void read_tool_heat(const Setting& table, const Setting& root, const Case& input, Tool& tool,
                    Diagnostics& diagnostics) {
  const Setting* heat = table.find("heat");
  if (!heat) return;
  if (!input.analysis.thermal)
    diagnostics.add(Mistake::conflict, heat->where, heat->path,
                    "found the thermal side of a tool, expected it with analysis.thermal = true only");
  read_constants(contact::ToolThermal::parameters, *heat, tool.thermal);
  contact::ToolMetal metal;
  read_constants(contact::ToolMetal::parameters, *heat, metal);
  read_lists(*heat, metal.heat_curves, diagnostics);
  const auto given = [&](const auto& parameter) {
    return heat->maybe<double>(parameter.info.name).has_value();
  };
  const auto parts = std::ranges::count_if(contact::ToolMetal::parameters, given);
  if (parts > 0 && (parts < 3 || heat->maybe<double>("effusivity")))
    diagnostics.add(Mistake::conflict, heat->where, heat->path,
                    "expected either effusivity, or conductivity, density and specific_heat together");
  else if (parts == 3) {
    tool.thermal.effusivity = metal.effusivity();
    tool.metal = metal;
  }
  const Setting* section = heat->find("section");
  if (const Setting* factors = heat->find("factors_at"); factors && !section)
    diagnostics.add(Mistake::missing_key, factors->where, factors->path,
                    fmt::format("found factors of a tool at one temperature, expected {}.section beside them",
                                heat->path));
  if (!section) return;
  if (parts < 3)
    diagnostics.add(Mistake::missing_key, section->where, section->path,
                    fmt::format("found nodes of a tool that has no metal, expected conductivity, density and "
                                "specific_heat in {} beside them",
                                heat->path));
  tool.section = read_section(*section, root, tool.outline, diagnostics);
}

} // namespace cnem::input
