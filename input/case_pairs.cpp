// What cannot be asked for together: the one table of pairs that are refused, each with its reason. What a
// method must promise for a feature stands in case_promises.cpp.
#include "input/case_pairs.hpp"

#include "input/case_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace cnem::input {
namespace {

using Text = std::string;

constexpr const char* one_of_them = "one of them";
constexpr const char* dynamics = "it with analysis.type = \"explicit\" only";
constexpr const char* on_voronoi_cells = "it with method.cells = \"voronoi\"";
constexpr const char* motion = "it with analysis.mechanical = true";

bool is_static(const Case& c) { return c.analysis.type == Analysis::Type::statics; }
bool is_round(const Case& c) { return c.analysis.space() == Space::revolution; }
bool local(const Case& c) { return !is_static(c) && c.time.local.on; }
bool resampled(const Case& c) { return c.adapt.resample; }
bool least_squares(const Case& c) { return c.method.options.least_squares; }

Text when(bool holds, const char* words) { return holds ? words : ""; }

Text in_statics(const Case& c) { return when(is_static(c), "in a static analysis"); }
Text in_dynamics(const Case& c) { return when(!is_static(c), "in an explicit analysis"); }
Text without_motion(const Case& c) {
  return when(!is_static(c) && c.analysis.thermal && !c.analysis.mechanical, "in an analysis without motion");
}
Text without_cells(const Case& c) {
  return when(c.method.name != "cnem", ("with method.name = \"" + c.method.name + "\"").c_str());
}
Text on_median_cells(const Case& c) {
  return when(c.analysis.dimensions() == 3 && c.method.name == "cnem" &&
                  c.method.options.cells == scni::CellKind::median,
              "with method.cells = \"median\"");
}
/// More of [report] than its units, or nothing at all.
bool evaluates(const Case& c) {
  return c.report.units.empty() || c.report.springback || c.report.blanking || c.report.cutting ||
         !c.report.experiments.empty();
}
Text with_ties(const Case& c) {
  return when(!c.domain.interfaces.empty(), "with domain.interfaces") +
         when(c.domain.interfaces.empty() && !c.periodic.empty(), "with periodic");
}
Text with_averaged_damage(const Case& c) {
  for (const plasticity::Material& material : c.materials)
    if (material.damage && material.damage->length > 0.0)
      return fmt::format("and damage of material '{}' that is averaged over a length", material.name);
  return "";
}

/// The first of a case's materials with an equation of state.
const plasticity::Material* compressible(const Case& c) {
  const auto found = std::find_if(c.materials.begin(), c.materials.end(), [](const plasticity::Material& m) {
    return m.equation_of_state.has_value();
  });
  return found == c.materials.end() ? nullptr : &*found;
}
/// The first of a case's materials whose sheet is not the same all around the axis.
const plasticity::Material* planar(const Case& c) {
  const auto found = std::find_if(c.materials.begin(), c.materials.end(), [](const plasticity::Material& m) {
    if (!m.anisotropy) return false;
    const auto [F, G, H, L, M, N] = m.anisotropy->coefficients();
    const auto same = [scale = F + G + H](double a, double b) { return std::abs(a - b) <= 1e-12 * scale; };
    return m.anisotropy->normal() != plasticity::Axis::y || !same(F, G) || !same(N, F + 2.0 * H) ||
           !same(L, M);
  });
  return found == c.materials.end() ? nullptr : &*found;
}
using Metal = plasticity::Material;

/// The path of what the first material has that something holds for; "": none.
Text first_path(const Case& c, const char* key, bool (*holds)(const Metal&)) {
  const auto found = std::find_if(c.materials.begin(), c.materials.end(), holds);
  return found == c.materials.end() ? "" : "materials." + found->name + key;
}
Text fibrous_path(const Case& c) {
  return first_path(c, ".elastic", [](const Metal& m) { return m.ply.has_value(); });
}
Text broken_ply_path(const Case& c) {
  return first_path(c, ".damage", [](const Metal& m) { return m.ply && m.damage; });
}
bool fibrous(const Case& c) { return !fibrous_path(c).empty(); }
bool failing(const Case& c) {
  return !first_path(c, "", [](const Metal& m) { return m.failure.has_value(); }).empty();
}
Text with_fibres(const Case& c) { return when(fibrous(c), "with an orthotropic material"); }
Text in_thin_dynamics(const Case& c) {
  return when(!is_static(c) && c.analysis.kinematics == Analysis::Kinematics::plane_stress,
              "in an explicit analysis of plane stress");
}

/// The first of a case's interfaces whose faces separate.
const Interface* cohesive(const Case& c) {
  const auto found = std::find_if(c.domain.interfaces.begin(), c.domain.interfaces.end(),
                                  [](const Interface& one) { return one.cohesive.has_value(); });
  return found == c.domain.interfaces.end() ? nullptr : &*found;
}
const BoundaryCondition* moving(const Case& c) {
  const auto found =
      std::find_if(c.boundary.begin(), c.boundary.end(),
                   [](const BoundaryCondition& condition) { return moves(condition.velocity); });
  return found == c.boundary.end() ? nullptr : &*found;
}

/// The first kinematic tool for which something holds.
const Tool* kinematic(const Case& c, bool (*holds)(const Tool&)) {
  const auto found = std::find_if(c.tools.begin(), c.tools.end(), [&](const Tool& tool) {
    return tool.response.is<contact::Kinematic>() && holds(tool);
  });
  return found == c.tools.end() ? nullptr : &*found;
}
bool rubs(const Tool& tool) { return tool.friction.rubs(); }
bool is_free(const Tool& tool) { return tool.drive.has_value(); }
bool stands(const Tool& tool) { return !tool.drive && !moves(tool.velocity); }

/// What is asked for at `path` is refused where `with` gives words. A key that is a default is dropped
/// instead, so that the resolved case reads back.
struct Pair {
  const char* path;  ///< as the docs have it
  const char* found; ///< what it asks for, "" for the key itself
  const char* other; ///< with what, for the docs
  Text (*with)(const Case&);
  const char* expected;
  const char* reason;
  bool (*asked)(const Case&) = nullptr; ///< null: whenever the key is there
  Text (*place)(const Case&) = nullptr; ///< the key of this case, where `path` has a pattern
};

const std::vector<Pair>& pairs() {
  static const std::vector<Pair> table{
      {"method.functions", "\"mls\"", "`method.name` other than `cnem`", without_cells,
       "it with method.name = \"cnem\", or method.name = \"efg\", whose functions they are",
       "natural elements alone have functions to choose", least_squares},
      {"method.functions", "\"mls\"", "`domain.cracks` in static analyses",
       [](const Case& c) {
         return when(is_static(c) && !c.domain.cracks.empty(), "with domain.cracks in a static analysis");
       },
       "\"sibson\" or \"laplace\"",
       "what enriches crack tips is multiplied with functions of natural neighbours", least_squares},
      {"method.support", "", "functions of natural neighbours, triangles or kernels",
       [](const Case& c) {
         return when(!least_squares(c) && c.method.name != "efg", "without moving least squares");
       },
       "it with method.functions = \"mls\" or method.name = \"efg\"", "nothing has supports"},
      {"method.functions", "", "`method.cells = \"median\"`", on_median_cells, on_voronoi_cells,
       "on median cells functions are linear in tetrahedra"},
      {"method.gauss_points", "", "`method.cells = \"median\"`", on_median_cells, on_voronoi_cells,
       "facets of median cells have one point, which is exact for linear functions"},

      {"time.step.local", "local steps", "`time.step.fixed`",
       [](const Case& c) { return when(c.time.fixed.has_value(), "and a fixed one"); }, one_of_them,
       "levels follow from the stable steps", local},
      {"time.step.local", "local steps", "`analysis.mechanical = false`", without_motion,
       "them with analysis.mechanical = true", "conduction is stable at a thousand times the step", local},
      {"time.step.local", "local steps", "`materials.*.damage.length`", with_averaged_damage, one_of_them,
       "what is averaged has to grow over the same time", local},

      {"analysis.mechanical", "false", "`analysis.thermal = false`",
       [](const Case& c) {
         return when(!is_static(c) && !c.analysis.thermal, "where analysis.thermal is false");
       },
       "one of them to be true", "nothing is solved for",
       [](const Case& c) { return !c.analysis.mechanical; }},
      {"tools", "", "`analysis.mechanical = false`", without_motion, motion, "nothing meets them"},
      {"contact", "", "`analysis.mechanical = false`", without_motion, motion, "nothing touches"},
      {"time.mass_scaling", "", "`analysis.mechanical = false`", without_motion, motion,
       "inertia does not act"},
      {"time.quasi_static", "true", "`analysis.mechanical = false`", without_motion, motion,
       "inertia does not act", [](const Case& c) { return c.time.quasi_static; }},
      {"initial.velocity", "", "`analysis.mechanical = false`", without_motion, motion, "nothing moves"},
      {"initial.spin", "", "`analysis.mechanical = false`", without_motion, motion, "nothing moves"},
      {"initial.velocity_gradient", "", "`analysis.mechanical = false`", without_motion, motion,
       "nothing moves"},
      {"report", "", "`analysis.mechanical = false`", without_motion, motion,
       "nothing is cut; its units may stand alone", evaluates},

      {"tools.*.friction.law", "friction", "`tools.*.response.law = \"kinematic\"`",
       [](const Case& c) { return when(kinematic(c, rubs), "on a kinematic tool"); }, "\"none\"",
       "what its faces bear along and across follows from the direction of its motion", nullptr,
       [](const Case& c) { return "tools." + kinematic(c, rubs)->name + ".friction.law"; }},
      {"tools.*.response.law", "\"kinematic\"", "`tools.*.mass`",
       [](const Case& c) { return when(kinematic(c, is_free), "of a tool with a mass"); }, "\"exact\"",
       "nodes take over a velocity that is prescribed", nullptr,
       [](const Case& c) { return "tools." + kinematic(c, is_free)->name + ".response.law"; }},
      {"tools.*.response.law", "\"kinematic\"", "a tool without `velocity`",
       [](const Case& c) { return when(kinematic(c, stands), "of a tool at rest"); }, "\"exact\"",
       "it pushes along its motion alone", nullptr,
       [](const Case& c) { return "tools." + kinematic(c, stands)->name + ".response.law"; }},

      {"materials.*.damage", "that of an orthotropic material", "plane strain",
       [](const Case& c) {
         return when(!broken_ply_path(c).empty() &&
                         c.analysis.kinematics != Analysis::Kinematics::plane_stress,
                     "without plane stress");
       },
       "analysis.kinematics = \"plane stress\"",
       "plies have no law for a mean tension that flow does not take", nullptr, broken_ply_path},
      {"materials.*.equation_of_state", "", "plane stress in explicit analyses", in_thin_dynamics,
       "analysis.kinematics = \"plane strain\"", "its pressure would act out of the plane", nullptr,
       [](const Case& c) {
         return first_path(c, ".equation_of_state",
                           [](const Metal& m) { return m.equation_of_state.has_value(); });
       }},
      {"method.pressure_exchange", "an exchange of volume", "plane stress in explicit analyses",
       in_thin_dynamics, "0", "sheets flow without constraint of their volume in the plane",
       [](const Case& c) { return c.method.pressure_exchange > 0.0; }},
      {"method.stress_annealing", "an annealing", "plane stress in explicit analyses", in_thin_dynamics, "0",
       "it shares out stresses with that out of the plane",
       [](const Case& c) { return c.method.stress_annealing > 0.0; }},
      {"report.springback", "true", "plane stress in explicit analyses", in_thin_dynamics, "false",
       "its elastic way back is that of plane strain", [](const Case& c) { return c.report.springback; }},
      {"materials.*.elastic", "an orthotropic elasticity", "axisymmetric analyses",
       [](const Case& c) { return when(is_round(c) && fibrous(c), "in an axisymmetric analysis"); },
       "law = \"isotropic\"", "fibres in a plane through the axis are not the same all around", nullptr,
       fibrous_path},
      {"materials.*.elastic", "an orthotropic elasticity", "three-dimensional analyses",
       [](const Case& c) {
         return when(c.analysis.dimensions() == 3 && fibrous(c), "in a three-dimensional analysis");
       },
       "law = \"isotropic\"", "fibres lie in the plane of the model, at one angle", nullptr, fibrous_path},
      {"materials.*.elastic", "an orthotropic elasticity", "`domain.cracks` in static analyses",
       [](const Case& c) {
         return when(is_static(c) && !c.domain.cracks.empty() && fibrous(c), "with domain.cracks");
       },
       "law = \"isotropic\"", "tip functions and interaction integrals are those of isotropic plates",
       nullptr, fibrous_path},
      {"materials.*.failure", "", "static analyses",
       [](const Case& c) { return when(is_static(c) && failing(c), "in a static analysis"); }, dynamics,
       "equilibrium is elastic", nullptr,
       [](const Case& c) {
         return first_path(c, ".failure", [](const Metal& m) { return m.failure.has_value(); });
       }},
      {"method.pressure_exchange", "an exchange of volume", "an orthotropic material", with_fibres, "0",
       "plies do not flow", [](const Case& c) { return c.method.pressure_exchange > 0.0; }},
      {"method.stress_annealing", "an annealing", "an orthotropic material", with_fibres, "0",
       "plies do not flow", [](const Case& c) { return c.method.stress_annealing > 0.0; }},
      {"report.springback", "true", "an orthotropic material", with_fibres, "false",
       "its elastic way back is isotropic", [](const Case& c) { return c.report.springback; }},
      {"fracture", "", "explicit analyses", in_dynamics, "it with analysis.type = \"static\" only",
       "tip functions and interaction integrals are those of equilibrium"},
      {"initial.spin", "a rotation in the meridian plane", "axisymmetric analyses",
       [](const Case& c) { return when(!is_static(c) && is_round(c), "in an axisymmetric analysis"); },
       "none", "rings do not turn out of their planes"},

      {"materials.*.anisotropy", "a sheet with a rolling direction or a normal beside the axis",
       "axisymmetric analyses",
       [](const Case& c) { return when(is_round(c) && planar(c), "in an axisymmetric analysis"); },
       "r0 = r45 = r90, L = M and normal = \"y\"",
       "what is different along and across the rolling direction is not the same all around", nullptr,
       [](const Case& c) { return "materials." + planar(c)->name + ".anisotropy"; }},

      {"domain.cracks", "", "axisymmetric static analyses",
       [](const Case& c) { return when(is_static(c) && is_round(c), "in an axisymmetric static analysis"); },
       "a plane one", "tip functions and interaction integrals are those of plane cracks"},
      {"analysis.mechanical", "false", "static analyses", in_statics, "true",
       "displacements are what it solves for", [](const Case& c) { return !c.analysis.mechanical; }},
      {"analysis.thermal", "true", "static analyses", in_statics, "false",
       "it solves for displacements alone, and metal expands from heat.reference_temperature to "
       "initial.temperature",
       [](const Case& c) { return c.analysis.thermal; }},
      {"time.step", "", "static analyses", in_statics, dynamics, "there is no step"},
      {"time.max_steps", "", "static analyses", in_statics, dynamics, "there is no step"},
      {"time.mass_scaling", "", "static analyses", in_statics, dynamics, "inertia does not act"},
      {"time.quasi_static", "", "static analyses", in_statics, dynamics, "inertia does not act"},
      {"tools", "", "static analyses", in_statics, dynamics, "equilibrium is solved for without contact"},
      {"contact", "", "static analyses", in_statics, dynamics, "equilibrium is solved for without contact"},
      {"initial.velocity", "", "static analyses", in_statics, dynamics, "nothing moves"},
      {"initial.spin", "", "static analyses", in_statics, dynamics, "nothing moves"},
      {"initial.velocity_gradient", "", "static analyses", in_statics, dynamics, "nothing moves"},
      {"initial.imperfections", "", "static analyses", in_statics, dynamics,
       "they are of the yield stress, and equilibrium is elastic"},
      {"domain.interfaces", "", "static analyses", in_statics, dynamics,
       "bonds are ties of the explicit step"},
      {"domain.fibres", "", "static analyses", in_statics, dynamics, "bonds are ties of the explicit step"},
      {"domain.interfaces.*.cohesive", "", "`analysis.thermal`",
       [](const Case& c) { return when(cohesive(c) && c.analysis.thermal, "with analysis.thermal = true"); },
       "analysis.thermal = false", "what heat crosses faces that separate is not known", nullptr,
       [](const Case& c) { return cohesive(c)->key + ".cohesive"; }},
      {"domain.interfaces.*.cohesive", "", "axisymmetric analyses",
       [](const Case& c) { return when(cohesive(c) && is_round(c), "in an axisymmetric analysis"); },
       "it in the plane", "tractions are per length of the interface, not of the surface that it turns to",
       nullptr, [](const Case& c) { return cohesive(c)->key + ".cohesive"; }},
      {"domain.interfaces.*.cohesive", "", "`time.step.local`",
       [](const Case& c) { return when(cohesive(c) && local(c), "with local time steps"); },
       "time.step.local = false", "both faces of a bond are kicked at once", nullptr,
       [](const Case& c) { return cohesive(c)->key + ".cohesive"; }},
      {"domain.regions", "", "static analyses", in_statics, dynamics, "regions are parts between interfaces"},
      {"periodic", "", "static analyses", in_statics, dynamics, "periods are ties of the explicit step"},
      {"output.checkpoint", "", "static analyses", in_statics, dynamics, "equilibrium is found in one go"},
      {"output.probes", "", "static analyses", in_statics, dynamics, "probes record a history"},
      {"report", "", "static analyses", in_statics, dynamics,
       "what is evaluated is a history of tools; its units may stand alone", evaluates},
      {"materials.*.equation_of_state", "", "static analyses",
       [](const Case& c) { return when(is_static(c) && compressible(c), "in a static analysis"); }, dynamics,
       "strains are small there, and pressure is proportional to them", nullptr,
       [](const Case& c) { return "materials." + compressible(c)->name + ".equation_of_state"; }},
      {"boundary.*.velocity", "a velocity", "static analyses",
       [](const Case& c) { return when(is_static(c) && moving(c), "in a static analysis"); },
       "a displacement (or a velocity of 0)", "there is no time to move in", nullptr,
       [](const Case& c) { return "boundary." + moving(c)->name + ".velocity"; }},

      {"adapt.resample", "true", "static analyses", in_statics, dynamics, "nothing calls for a new cloud",
       resampled},
      {"adapt.resample", "true", "`method.lagrangian = \"total\"`",
       [](const Case& c) {
         return when(c.method.lagrangian == Method::Lagrangian::total, "with method.lagrangian = \"total\"");
       },
       "\"periodic\"", "nodes are changed at a new reference", resampled},
      {"method.cells", "\"voronoi\"", "new references without `adapt.resample`",
       [](const Case& c) {
         return when(!is_static(c) && !resampled(c) && c.method.lagrangian != Method::Lagrangian::total,
                     "on new references without adapt.resample");
       },
       "\"median\", adapt.resample = true or method.lagrangian = \"total\"",
       "they need tetrahedra that hold the boundary, which a pass sees to",
       [](const Case& c) {
         return c.analysis.dimensions() == 3 && c.method.options.cells == scni::CellKind::voronoi;
       }},
      {"adapt.separate", "true", "`periodic` in space",
       [](const Case& c) {
         return when(c.analysis.dimensions() == 3 && !c.periodic.empty(), "with periodic in space");
       },
       one_of_them, "a cut would have to meet both sides of a period alike",
       [](const Case& c) { return c.adapt.separate; }},
      {"adapt.window", "", "axisymmetric analyses",
       [](const Case& c) { return when(is_round(c), "in an axisymmetric analysis"); },
       "it with analysis.kinematics = \"plane strain\"",
       "what is fed in along the radius is not as wide as what is there"},
      {"adapt.window", "", "`adapt.resample = false`",
       [](const Case& c) { return when(!resampled(c), "where adapt.resample is false"); }, "true there",
       "matter comes and goes at passes"},
      {"cutting.window", "true", "`adapt.resample = false`",
       [](const Case& c) { return when(!resampled(c), "where adapt.resample is false"); }, "true there",
       "matter comes and goes at passes", [](const Case& c) { return c.cutting && c.cutting->window; }},
      {"adapt.window", "", "ties", with_ties, one_of_them, "ties have no partners beyond the end"},
      {"report.springback", "true", "ties", with_ties, one_of_them, "tied nodes are not let go",
       [](const Case& c) { return c.report.springback; }},
  };
  return table;
}

} // namespace

void check_pairs(Setting& root, const Case& input, Diagnostics& diagnostics) {
  for (const Pair& pair : pairs()) {
    const Text with = pair.with(input);
    if (with.empty() || (pair.asked && !pair.asked(input))) continue;
    const Text path = pair.place ? pair.place(input) : pair.path;
    const Setting* setting = root.find(path);
    if (!setting) continue;
    if (setting->given)
      diagnostics.add(Mistake::conflict, setting->where, setting->path,
                      fmt::format("found {}{}{}, expected {}: {}", pair.found, *pair.found ? " " : "", with,
                                  pair.expected, pair.reason));
    else
      root.erase(path);
  }
}

std::string pairs_table() {
  Text text = "| key | not with | because |\n| --- | --- | --- |\n";
  for (const Pair& pair : pairs())
    text += fmt::format("| `{}` | {} | {} |\n", pair.path, pair.other, pair.reason);
  return text;
}

} // namespace cnem::input
