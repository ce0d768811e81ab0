// Tools with a mass of their own, and mass scaling, of the case reader.
#include "input/case_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <utility>
#include <vector>

namespace cnem::input {
void read_drive(const Setting& table, const Case& input, Tool& tool, Diagnostics& diagnostics) {
  const Setting* mass = table.find("mass");
  if (!mass) {
    for (const char* key : {"force", "initial_velocity", "direction"})
      if (const Setting* found = table.find(key))
        diagnostics.add(
            Mistake::missing_key, found->where, found->path,
            fmt::format("found {} of a tool without mass, expected {}.mass = \"50 kg/m\" beside it, or "
                        "a velocity alone",
                        key, table.path));
    return;
  }
  if (const Setting* velocity = table.find("velocity"))
    return diagnostics.add(Mistake::conflict, velocity->where, velocity->path,
                           "found a prescribed velocity and a mass, expected one of them: a tool with a mass "
                           "moves by force and initial_velocity");
  contact::ToolDrive<2>& drive = tool.drive.emplace();
  drive.mass = std::get<double>(mass->value);
  if (const auto force = table.maybe<VectorFunction>("force"))
    for (std::size_t k = 0; k < 2; ++k) drive.force[k] = (*force)[k].value_or(TimeTable());
  drive.initial_velocity = table.maybe<Vec2>("initial_velocity").value_or(Vec2::Zero());
  const Setting* direction = table.find("direction");
  if (!direction) return;
  Vec2 line = std::get<Vec2>(direction->value);
  if (!(line.stableNorm() > 0.0))
    return diagnostics.add(Mistake::range, direction->where, direction->path,
                           "found \"0 0\", expected a direction such as \"0 1\"");
  if (input.analysis.kinematics == Analysis::Kinematics::axisymmetric && line.x() != 0.0)
    return diagnostics.add(
        Mistake::conflict, direction->where, direction->path,
        "found a radial direction, expected \"0 1\": a rigid body of revolution moves along its "
        "axis alone");
  line.stableNormalize();
  drive.free = line * line.transpose();
  // What a guide would take without a trace was not meant.
  const Vec2 across(-line.y(), line.x());
  if (std::abs(across.dot(drive.initial_velocity)) > 1e-9 * drive.initial_velocity.norm())
    diagnostics.add(Mistake::conflict, table.find("initial_velocity")->where,
                    table.find("initial_velocity")->path,
                    "found a velocity across the direction of the tool, expected one along it");
  if (const Setting* force = table.find("force"))
    for (std::size_t k = 0; k < 2; ++k) {
      const std::vector<double>& values = drive.force[k].values();
      if (line.cwiseAbs()[static_cast<int>(k)] < 1e-9 &&
          std::any_of(values.begin(), values.end(), [](double value) { return value != 0.0; }))
        diagnostics.add(
            Mistake::conflict, force->where, force->path,
            fmt::format("found a force along {}, where the direction of the tool does not let it move, "
                        "expected 0 there",
                        axis_name(k)));
    }
}

void read_mass_scaling(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting* table = root.find("time.mass_scaling");
  if (!table) return;
  MassScaling& scaling = result.time.mass_scaling.emplace();
  const auto factor = table->maybe<double>("factor"), step = table->maybe<double>("step"),
             cell = table->maybe<double>("cell");
  scaling = {factor.value_or(1.0), step.value_or(0.0), cell.value_or(0.0)};
  std::vector<std::string_view> found;
  for (const auto& [name, value] :
       {std::pair{"factor", &factor}, std::pair{"step", &step}, std::pair{"cell", &cell}})
    if (*value) found.emplace_back(name);
  if (found.size() != 1)
    diagnostics.add(
        Mistake::conflict, table->where, table->path,
        fmt::format("found {}, expected one of factor, step, cell",
                    found.empty() ? "none of them" : fmt::format("{}", fmt::join(found, " and "))));
}

} // namespace cnem::input
