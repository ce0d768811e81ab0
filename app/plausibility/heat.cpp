// Temperatures of degrees Celsius in kelvin, and metals of tools that no tool is made of.
#include "app/plausibility/usual_size.hpp"

#include <fmt/format.h>

namespace cnem::app {

namespace {

constexpr double coldest = 100.0, liquid_nitrogen = 77.0; // K

void doubt_temperature(const input::Case& input, const std::string& key, double value, Doubts& doubts) {
  doubts.push_back(doubt_about(
      input, key, fmt::format("{:g} K are {:g} °C: are {:g} degC meant?", value, value - 273.15, value)));
}

/// Those that are not taken from the start.
void doubt_temperatures(const input::Case& input, Doubts& doubts) {
  const double start = input.initial.temperature;
  if (start < coldest) doubt_temperature(input, "initial.temperature", start, doubts);
  const auto look_at = [&](const std::string& key, const TimeTable& table, double least = coldest) {
    for (const double value : table.values())
      if (value < least && value != start) return doubt_temperature(input, key, value, doubts);
  };
  for (const input::Region& region : input.domain.regions)
    look_at(fmt::format("domain.regions.{}.temperature", region.name), TimeTable(region.temperature));
  for (const input::BoundaryCondition& condition : input.boundary) {
    if (condition.temperature)
      look_at(fmt::format("boundary.{}.temperature", condition.name), *condition.temperature);
    if (condition.convection)
      look_at(fmt::format("boundary.{}.convection.ambient", condition.name), condition.convection->ambient);
  }
  for (const input::Coolant& coolant : input.coolants)
    look_at(fmt::format("coolants.{}.temperature", coolant.name), coolant.ambient, liquid_nitrogen);
  for (const input::Tool& tool : input.tools)
    look_at(fmt::format("tools.{}.heat.temperature", tool.name), TimeTable(tool.thermal.temperature));
}

constexpr Usual tool_density{"density", "kg/m³", 2e3, 20e3, "tools"};
constexpr Usual tool_specific_heat{"specific_heat", "J/(kg K)", 100.0, 1500.0, "tools"};
constexpr Usual tool_conductivity{"conductivity", "W/(m K)", 1.0, 2500.0, "tools"};

} // namespace

void doubt_heat(const input::Case& input, Doubts& doubts) {
  if (!input.analysis.thermal) return;
  doubt_temperatures(input, doubts);
  for (const input::Tool& tool : input.tools) {
    if (!tool.metal) continue;
    const std::string table = fmt::format("tools.{}.heat", tool.name);
    doubt_size(input, table, tool_density, tool.metal->density, doubts);
    doubt_size(input, table, tool_specific_heat, tool.metal->specific_heat, doubts);
    doubt_size(input, table, tool_conductivity, tool.metal->conductivity, doubts);
  }
}

} // namespace cnem::app
