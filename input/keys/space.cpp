// Keys of three-dimensional analyses, and which keys have a meaning in the plane alone.
#include "input/keys/keys.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace cnem::input {
namespace {

namespace d = dimension;
using enum Type;

struct Scoped {
  const char* path; ///< of a key; what lies below it goes with it
  Scope scope;
  const char* reason;
};

constexpr std::array scopes{
    Scoped{"cutting", Scope::plane, "what it makes is an outline"},
    Scoped{"domain.cracks", Scope::plane, "a polyline does not cut a body in space"},
    Scoped{"domain.interfaces", Scope::plane, "a polyline does not divide a body in space"},
    Scoped{"domain.fibres", Scope::plane, "a straight line does not divide a body in space"},
    Scoped{"domain.regions", Scope::plane, "only interfaces divide a workpiece, and in space there are none"},
    Scoped{"domain.block", Scope::space, "a workpiece in the plane has an outline, domain.outer"},
    Scoped{"domain.extrude", Scope::space, "a workpiece in the plane is its outline"},
    Scoped{"domain.revolve", Scope::space, "a body of revolution has axisymmetric kinematics"},
    Scoped{"domain.stl", Scope::space, "a workpiece in the plane has an outline, domain.outer"},
    Scoped{"cloud.pattern", Scope::plane, "nodes in space are laid out in one way"},
    Scoped{"cloud.jitter", Scope::plane, "nodes in space are laid out in one way"},
    Scoped{"cloud.seed", Scope::plane, "nodes in space are laid out in one way"},
    Scoped{"cloud.nodes", Scope::plane, "nodes in space come with a surface"},
    Scoped{"cloud.nodes_file", Scope::plane, "nodes in space come with a surface"},
    Scoped{"cloud.refine.*.tips", Scope::plane, "a polyline does not cut a body in space"},
    Scoped{"initial.spin", Scope::plane, "a rotation in space needs an axis"},
    Scoped{"initial.velocity_gradient", Scope::plane, "its components are those of the plane"},
    Scoped{"initial.imperfections", Scope::plane, "they lie along polylines of the plane"},
    Scoped{"tools.*.shape", Scope::space, "a tool in the plane has an outline, such as a rectangle"},
    Scoped{"tools.*.plane", Scope::space, "a tool in the plane has an outline, such as a rectangle"},
    Scoped{"tools.*.box", Scope::space, "a tool in the plane has an outline, such as a rectangle"},
    Scoped{"tools.*.extrude", Scope::space, "a tool in the plane is its outline"},
    Scoped{"tools.*.profile", Scope::space, "a tool in the plane is its outline"},
    Scoped{"tools.*.stl", Scope::space, "a tool in the plane has an outline, such as a rectangle"},
    Scoped{"tools.*.place", Scope::space, "a tool in the plane is turned by rotate"},
    Scoped{"tools.*.equal_areas", Scope::plane, "edges on arcs are not shared out in space"},
    Scoped{"tools.*.heat.section", Scope::plane, "what conducts in a tool is a plane section"},
    Scoped{"coolants", Scope::plane, "faces that a cut makes are of the plane"},
    Scoped{"adapt.cracks", Scope::plane, "broken matter in space parts where it goes through"},
    Scoped{"adapt.thinnest_film", Scope::plane, "broken matter in space parts where it goes through"},
    Scoped{"adapt.placement", Scope::plane, "nodes in space are put between others"},
    Scoped{"adapt.surface_spacing", Scope::plane, "clouds in space are refined by an indicator and at tools"},
    Scoped{"adapt.rest_factor", Scope::plane, "clouds in space are refined by an indicator and at tools"},
    Scoped{"adapt.window", Scope::plane, "ends of a window are cut through an outline"},
    Scoped{"method.cells", Scope::space, "cells in the plane are those of Voronoi"},
    Scoped{"fracture", Scope::plane, "a crack front in space is a line, not a tip"},
    Scoped{"output.drawing.mirror", Scope::plane, "pictures of space show what the case has"},
    Scoped{"output.drawing.view", Scope::plane, "pictures of space show the whole body"},
    Scoped{"output.drawing.eye", Scope::space, "pictures of the plane are seen from above"},
    Scoped{"output.surface", Scope::space, "files of the plane have its cells"},
    Scoped{"output.polyhedra", Scope::space, "files of the plane have its cells"},
    Scoped{"output.sections", Scope::space, "pictures of the plane show its cells"},
    Scoped{"output.notes", Scope::plane, "notes stand beside series, which pictures of space are not"},
    Scoped{"output.windows", Scope::plane, "pictures of space show the whole body"},
    Scoped{"report.blanking.sections", Scope::space, "a cut in the plane has one section"},
    Scoped{"report.blanking.centre", Scope::space, "a cut in the plane has one section"},
    Scoped{"report.cutting", Scope::plane, "cuts are followed along the outline of the workpiece"},
    Scoped{"report.springback", Scope::plane, "bodies are let go in the plane only"},
    Scoped{"report.experiment", Scope::plane, "what a cut takes is evaluated in the plane"},
};

/// Outlines of tools, and what lies below these keys: of a plane, also where the tool is in space.
constexpr std::array flat{"tools.*.start",  "tools.*.path",    "tools.*.rectangle", "tools.*.circle",
                          "tools.*.rotate", "tools.*.drawing", "tools.*.profile"};

} // namespace

namespace {

void add_ends(Keys& k, const std::string& at, const std::string& low, const std::string& high) {
  k.add(at + ".low", text, "Name of the boundary piece at the beginning.").fallback("\"" + low + "\"");
  k.add(at + ".high", text, "Name of the boundary piece at the end.").fallback("\"" + high + "\"");
}

/// What makes bodies of outlines and files.
void add_sweeps(Keys& k) {
  k.add("domain.extrude", table,
        "The outline `domain.outer` with `domain.holes`, drawn along z. Its pieces give their names to the "
        "sides.");
  k.add("domain.extrude.from", quantity, "Lower end.").unit(d::length).fallback("\"0 m\"");
  k.add("domain.extrude.to", quantity, "Upper end.").unit(d::length).required().example("\"2 mm\"");
  add_ends(k, "domain.extrude", "z-", "z+");
  k.add("domain.revolve", table,
        "The outline `domain.outer` with `domain.holes`, as in axisymmetric analyses (x the radius, y along "
        "the "
        "axis), turned about the axis, which becomes z, from the x axis on. Its pieces give their names to "
        "what "
        "they sweep.");
  k.add("domain.revolve.angle", quantity, "A whole turn leaves no ends.")
      .unit(d::angle)
      .in({.low = 0.0, .high = 2.0 * std::numbers::pi, .low_open = true})
      .fallback("\"360 deg\"");
  k.add("domain.revolve.origin", vector, "Where (0, 0) of the outline comes to lie.")
      .unit(d::length)
      .fallback("\"0 0 0 m\"")
      .example("\"0 0 5 mm\"");
  add_ends(k, "domain.revolve", "theta-", "theta+");
  k.add(
      "domain.stl", table,
      "A closed surface from an STL file, remeshed to `cloud.spacing`. Sharp edges and those between solids "
      "stay and divide it into boundary pieces: they are called as the solid (`surface` without a name), "
      "with "
      "`-1`, `-2` and so on from the largest on where there are several.");
  add_stl(k, "domain.stl", "\"part.stl\"");
  k.add("domain.stl.crease_angle", quantity, "Edges at which normals turn by more are sharp.")
      .unit(d::angle)
      .in({.low = 0.0, .high = std::numbers::pi, .low_open = true})
      .fallback("\"40 deg\"");
  k.add("domain.stl.names", table_list, "Names of single pieces; several may share one.");
  k.add("domain.stl.names[].at", vector, "A place on the piece, after the shift.")
      .unit(d::length)
      .required()
      .example("\"0 5 1 mm\"");
  k.add("domain.stl.names[].name", text, "").required().example("\"left\"");
}

} // namespace

void add_block(Keys& k) {
  const std::string at = "domain.block.";
  k.add("domain.block", table, "A workpiece in space of a usual shape.");
  k.add(at + "shape", choice,
        "`box`: faces `x-`, `x+`, `y-`, `y+`, `z-`, `z+`. `cylinder`: about an axis along z, faces `bottom`, "
        "`top` and `side` (and `inside`, of a tube), with the cuts `x-` and `y-` of a half and a quarter, "
        "`theta-` "
        "and `theta+` of a sector. `sphere`: faces `side` (and `inside`, of a shell) and cuts alike, `z-` of "
        "an "
        "eighth.")
      .one_of({"box", "cylinder", "sphere"})
      .fallback("\"box\"");
  k.add(at + "from", vector, "A corner of the box.")
      .unit(d::length)
      .required()
      .when("shape", {"box"})
      .example("\"0 0 0 mm\"");
  k.add(at + "to", vector, "The opposite corner.")
      .unit(d::length)
      .required()
      .when("shape", {"box"})
      .example("\"20 10 5 mm\"");
  k.add(at + "centre", vector, "Centre of the sphere, or of the bottom of the cylinder.")
      .unit(d::length)
      .when("shape", {"cylinder", "sphere"})
      .example("\"0 0 0 mm\"")
      .computed("0");
  k.add(at + "radius", quantity, "")
      .unit(d::length)
      .in(positive)
      .required()
      .when("shape", {"cylinder", "sphere"});
  k.add(at + "inner_radius", quantity, "Of a tube or a shell.")
      .unit(d::length)
      .in(positive)
      .when("shape", {"cylinder", "sphere"});
  k.add(at + "length", quantity, "Along z.")
      .unit(d::length)
      .in(positive)
      .required()
      .when("shape", {"cylinder"});
  k.add(
       at + "part", choice,
       "What is there, seen from the centre: all, the half with y > 0, the quarter with x > 0 and y > 0, the "
       "eighth of a sphere with x, y, z > 0, or the sector from the x axis to `angle`.")
      .one_of({"whole", "half", "quarter", "eighth", "sector"})
      .fallback("\"whole\"")
      .when("shape", {"cylinder", "sphere"});
  k.add(at + "angle", quantity, "Of a sector, counter-clockwise about z.")
      .unit(d::angle)
      .in({.low = 0.0, .high = 2.0 * std::numbers::pi, .low_open = true, .high_open = true})
      .when("shape", {"cylinder", "sphere"})
      .example("\"30 deg\"");
  k.add(at + "grid", boolean,
        "Boxes of six tetrahedra each, all of one spacing. Without: near-equilateral triangles on the "
        "surface and "
        "nodes inside, which may be refined, as of other bodies.")
      .fallback("true")
      .when("shape", {"box", "cylinder"});
  add_sweeps(k);
}

void mark_scopes(Keys& k) {
  for (Key& key : k.all)
    key.planar =
        std::any_of(flat.begin(), flat.end(), [&](const char* path) { return below(key.path, path); });
  for (const Scoped& scoped : scopes) {
    const std::string path = scoped.path;
    for (Key& key : k.all)
      if (key.path == path || key.path.starts_with(path + ".")) {
        key.scope = scoped.scope;
        key.scope_reason = scoped.reason;
      }
  }
  for (Key& key : k.all) // outlines lie in a plane, also where bodies in space are made of them
    for (const char* outline : {"domain.outer.", "domain.drawing.", "domain.holes."})
      if (key.path.starts_with(outline)) key.planar = true;
}

} // namespace cnem::input
