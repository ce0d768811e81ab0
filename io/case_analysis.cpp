// What the kind of analysis asks of the rest of a case, and the evaluation of crack tips.
#include "io/case_parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::io {
namespace {

/// Records that a key has no meaning in this analysis.
void refuse(const Setting& root, std::string_view path, const std::string& why, Diagnostics& diagnostics) {
  const Setting* setting = root.find(path);
  if (setting && setting->given) diagnostics.add(Mistake::conflict, setting->where, setting->path, why);
}

/// Keys that have no meaning in this kind of analysis.
const std::vector<std::string>& meaningless(Analysis::Type type) {
  static const std::vector<std::string> in_explicit{"fracture"};
  static const std::vector<std::string> in_static{"time.step", "tools", "initial.velocity", "initial.spin"};
  return type == Analysis::Type::statics ? in_static : in_explicit;
}

bool moves(const VectorFunction& velocity) {
  return std::any_of(velocity.begin(), velocity.end(), [](const std::optional<TimeTable>& component) {
    return component && std::any_of(component->values().begin(), component->values().end(),
                                    [](double v) { return v != 0.0; });
  });
}

} // namespace

void read_fracture(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("fracture");
  Fracture& fracture = result.fracture;
  fracture.enrichment = table.get<bool>("enrichment");
  fracture.enrichment_radius = table.maybe<double>("enrichment_radius");
  fracture.integral_inner = table.maybe<double>("integral.inner");
  fracture.integral_outer = table.maybe<double>("integral.outer");
  const Setting* inner = table.find("integral.inner");
  if (inner && fracture.integral_outer && !(*fracture.integral_inner < *fracture.integral_outer))
    diagnostics.add(Mistake::range, inner->where, inner->path,
                    fmt::format("found {:g} m, expected less than integral.outer = {:g} m",
                                *fracture.integral_inner, *fracture.integral_outer));
}

void check_analysis(Setting& root, const Case& result, Diagnostics& diagnostics) {
  const bool statics = result.analysis.type == Analysis::Type::statics;
  for (const std::string& path : meaningless(result.analysis.type)) {
    refuse(root, path,
           fmt::format("found in {} analysis, expected it with analysis.type = \"{}\" only",
                       statics ? "a static" : "an explicit", statics ? "explicit" : "static"),
           diagnostics);
    root.erase(path);
  }
  if (!statics) {
    if (result.analysis.kinematics == Analysis::Kinematics::plane_stress)
      refuse(root, "analysis.kinematics",
             "found \"plane stress\", expected it with analysis.type = \"static\" only", diagnostics);
    if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric)
      refuse(root, "initial.spin",
             "found a rotation in the meridian plane, expected none in an axisymmetric analysis",
             diagnostics);
    return;
  }
  if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric)
    refuse(root, "analysis.kinematics",
           "found \"axisymmetric\", expected it with analysis.type = \"explicit\" only", diagnostics);
  if (result.analysis.thermal)
    refuse(root, "analysis.thermal",
           "found true in a static analysis, which solves for displacements alone, expected false",
           diagnostics);
  for (const BoundaryCondition& condition : result.boundary)
    if (moves(condition.velocity))
      refuse(root, "boundary." + condition.name + ".velocity",
             "found a velocity in a static analysis, expected a displacement (or a velocity of 0)",
             diagnostics);
}

} // namespace cnem::io
