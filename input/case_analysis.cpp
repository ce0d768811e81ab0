// What the kind of analysis asks of the rest of a case, and the evaluation of crack tips.
#include "input/case_parts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::input {
namespace {

/// Records that a key has no meaning in this analysis; a default is dropped, so that the resolved case can be
/// read again.
void refuse(Setting& root, std::string_view path, const std::string& why, Diagnostics& diagnostics) {
  const Setting* setting = root.find(path);
  if (!setting) return;
  if (setting->given) return diagnostics.add(Mistake::conflict, setting->where, setting->path, why);
  root.erase(path);
}

void check_local_steps(Setting& root, const Case& result, Diagnostics& diagnostics) {
  const auto clash = [&](const std::string& other, const std::string& expected) {
    refuse(root, "time.step.local", fmt::format("found local steps {}, expected {}", other, expected),
           diagnostics);
  };
  const std::string one = "one of them";
  if (result.time.mass_scaling) clash("with time.mass_scaling", one);
  if (result.method.pressure_exchange > 0.0) clash("with method.pressure_exchange", one);
  for (const plasticity::Material& material : result.materials)
    if (material.damage) clash(fmt::format("with material '{}', which has a damage law", material.name), one);
  if (result.contact.active) clash("with contact.deformable", one);
  for (const Tool& tool : result.tools)
    if (tool.drive)
      clash(fmt::format("with tool '{}', which has a mass", tool.name), "tools of given velocity");
  if (result.time.fixed) clash("and a fixed one", one);
  if (!result.analysis.mechanical)
    clash("in an analysis without motion", "them with analysis.mechanical = true");
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
  if (result.analysis.type != Analysis::Type::statics) {
    if (!result.analysis.mechanical && !result.analysis.thermal)
      refuse(root, "analysis.mechanical",
             "found false where analysis.thermal is false: nothing is solved for, expected one of them to be "
             "true",
             diagnostics);
    if (!result.analysis.mechanical)
      for (const char* path : {"tools", "contact", "time.mass_scaling", "initial.velocity", "initial.spin",
                               "initial.velocity_gradient", "report"})
        refuse(root, path, "found in an analysis without motion, expected it with analysis.mechanical = true",
               diagnostics);
    if (result.time.local.on) check_local_steps(root, result, diagnostics);
    if (result.method.pressure_exchange > 0.0)
      for (const plasticity::Material& material : result.materials)
        if (material.damage)
          refuse(root, "method.pressure_exchange",
                 fmt::format(
                     "found an exchange with material '{}', which has a damage law, expected one of them",
                     material.name),
                 diagnostics);
    if (result.analysis.kinematics == Analysis::Kinematics::plane_stress)
      refuse(root, "analysis.kinematics",
             "found \"plane stress\", expected it with analysis.type = \"static\" only", diagnostics);
    if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric)
      refuse(root, "initial.spin",
             "found a rotation in the meridian plane, expected none in an axisymmetric analysis",
             diagnostics);
    refuse(root, "fracture",
           "found in an explicit analysis, expected it with analysis.type = \"static\" only", diagnostics);
    return;
  }
  if (result.analysis.dimensions() == 3)
    refuse(root, "analysis.type",
           "found \"static\" in a three-dimensional analysis, expected \"explicit\": what equilibrium is "
           "solved with are operators of the plane",
           diagnostics);
  if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric)
    refuse(root, "domain.cracks", "found in an axisymmetric static analysis, expected a plane one",
           diagnostics);
  const std::string dynamic =
      "found in a static analysis, expected it with analysis.type = \"explicit\" only";
  if (!result.analysis.mechanical)
    refuse(root, "analysis.mechanical",
           "found false in a static analysis, which solves for displacements, expected true", diagnostics);
  if (result.analysis.thermal)
    refuse(root, "analysis.thermal",
           "found true in a static analysis, which solves for displacements alone, expected false",
           diagnostics);
  for (const char* path :
       {"time.step", "time.max_steps", "time.mass_scaling", "tools", "contact", "initial.velocity",
        "initial.spin", "initial.velocity_gradient", "initial.imperfections", "domain.interfaces",
        "domain.regions", "periodic", "output.checkpoint", "output.probes", "report"})
    refuse(root, path, dynamic, diagnostics);
  for (const plasticity::Material& material : result.materials)
    if (material.expansion != 0.0 && material.expansion_reference != result.initial.temperature)
      refuse(root, "materials." + material.name + ".heat.expansion",
             "found a thermal strain in a static analysis, which does not apply it, expected "
             "heat.reference_temperature = initial.temperature",
             diagnostics);
  for (const BoundaryCondition& condition : result.boundary)
    if (moves(condition.velocity))
      refuse(root, "boundary." + condition.name + ".velocity",
             "found a velocity in a static analysis, expected a displacement (or a velocity of 0)",
             diagnostics);
}

} // namespace cnem::input
