// Tools with a mass of their own, and mass scaling, of the case reader.
#include "input/case_parts.hpp"
#include "input/constants.hpp"
#include "input/schema/conversion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>
#include <utility>
#include <vector>

namespace cnem::input {
namespace {

/// What stands in a direction that a guide does not let the tool go, and would be taken without a trace.
void check_across(const Setting* setting, const std::array<TimeTable, 3>& tables, const Vec3& line,
                  const char* what, Diagnostics& diagnostics) {
  if (!setting) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& values = tables[k].values();
    if (line.cwiseAbs()[static_cast<int>(k)] < 1e-9 &&
        std::any_of(values.begin(), values.end(), [](double value) { return value != 0.0; }))
      diagnostics.add(
          Mistake::conflict, setting->where, setting->path,
          fmt::format("found a {} along {}, where the direction of the tool does not let it move, "
                      "expected 0 there",
                      what, axis_name(k)));
  }
}

void read_guide(const Setting& table, const Case& input, const Tool& tool, contact::ToolDrive<3>& drive,
                Diagnostics& diagnostics) {
  const Setting* direction = table.find("direction");
  if (!direction) return;
  Vec3 line = table.vector("direction");
  if (!(line.stableNorm() > 0.0))
    return diagnostics.add(Mistake::range, direction->where, direction->path,
                           input.analysis.dimensions() == 3
                               ? "found \"0 0 0\", expected a direction such as \"0 0 1\""
                               : "found \"0 0\", expected a direction such as \"0 1\"");
  if (input.analysis.kinematics == Analysis::Kinematics::axisymmetric && line.x() != 0.0)
    return diagnostics.add(
        Mistake::conflict, direction->where, direction->path,
        "found a radial direction, expected \"0 1\": a rigid body of revolution moves along its "
        "axis alone");
  line.stableNormalize();
  drive.free = line * line.transpose();
  if (drive.spring) drive.spring->along = line;
  // What a guide would take without a trace was not meant.
  const Vec3 across = drive.initial_velocity - line.dot(drive.initial_velocity) * line;
  if (across.norm() > 1e-9 * drive.initial_velocity.norm())
    diagnostics.add(Mistake::conflict, table.find("initial_velocity")->where,
                    table.find("initial_velocity")->path,
                    "found a velocity across the direction of the tool, expected one along it");
  check_across(table.find("force"), drive.force, line, "force", diagnostics);
  std::array<TimeTable, 3> velocity;
  for (std::size_t k = 0; k < 3; ++k) velocity[k] = tool.velocity[k].value_or(TimeTable());
  check_across(table.find("velocity"), velocity, line, "velocity of the mount", diagnostics);
}

void read_spring(const Setting& table, const Setting& spring, contact::ToolDrive<3>& drive,
                 Diagnostics& diagnostics) {
  const Setting* direction = table.find("direction");
  if (!direction || !direction->given) // which way the default would push is nobody's wish
    diagnostics.add(
        Mistake::missing_key, spring.where, spring.path,
        fmt::format("found a spring of a tool without direction, expected {}.direction = \"0 -1\" "
                    "beside it, the way it pushes",
                    table.path));
  auto law = read_law<contact::Spring>(contact::Springs{}, spring, diagnostics);
  if (!law) return;
  drive.spring.emplace().spring = std::move(*law);
  if (const auto ramp = spring.maybe<double>("ramp"))
    drive.spring->spring.charge = ramp_table(*ramp, 0.0, 1.0, true);
}

} // namespace

void read_drive(const Setting& table, const Case& input, Tool& tool, Diagnostics& diagnostics) {
  const Setting* mass = table.find("mass");
  const Setting* spring = table.find("spring");
  if (!mass) {
    for (const char* key : {"force", "initial_velocity", "direction", "spring", "damping"})
      if (const Setting* found = table.find(key))
        diagnostics.add(
            Mistake::missing_key, found->where, found->path,
            fmt::format("found {} of a tool without mass, expected {}.mass = \"50 kg/m\" beside it, or "
                        "a velocity alone",
                        key, table.path));
    return;
  }
  if (const Setting* velocity = table.find("velocity"); velocity && !spring)
    return diagnostics.add(
        Mistake::conflict, velocity->where, velocity->path,
        fmt::format("found a prescribed velocity and a mass, expected one of them: a tool "
                    "with a mass moves by force and initial_velocity, or by {}.spring from "
                    "a mount that has the velocity",
                    table.path));
  contact::ToolDrive<3>& drive = tool.drive.emplace();
  drive.mass = std::get<double>(mass->value);
  drive.damping = table.maybe<double>("damping").value_or(0.0);
  if (const auto force = table.maybe<VectorFunction>("force"))
    for (std::size_t k = 0; k < 3; ++k) drive.force[k] = (*force)[k].value_or(TimeTable());
  if (table.find("initial_velocity")) drive.initial_velocity = table.vector("initial_velocity");
  if (spring) read_spring(table, *spring, drive, diagnostics);
  read_guide(table, input, tool, drive, diagnostics);
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
