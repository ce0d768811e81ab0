// Keys of three-dimensional analyses, and which keys have a meaning in the plane alone.
#include "input/keys/keys.hpp"

#include <algorithm>
#include <array>

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
    Scoped{"cutting", Scope::plane, "what it makes is an outline; a workpiece in space is a domain.block"},
    Scoped{"domain.outer", Scope::plane, "a workpiece in space is a domain.block"},
    Scoped{"domain.drawing", Scope::plane, "a workpiece in space is a domain.block"},
    Scoped{"domain.holes", Scope::plane, "outlines bound areas; a workpiece in space is a domain.block"},
    Scoped{"domain.cracks", Scope::plane, "a polyline does not cut a body in space"},
    Scoped{"domain.interfaces", Scope::plane, "a polyline does not divide a body in space"},
    Scoped{"domain.regions", Scope::plane, "only interfaces divide a workpiece, and a block has none"},
    Scoped{"domain.block", Scope::space, "a workpiece in the plane has an outline, domain.outer"},
    Scoped{"cloud.pattern", Scope::plane, "nodes of a block lie on its grid"},
    Scoped{"cloud.jitter", Scope::plane, "nodes of a block lie on its grid"},
    Scoped{"cloud.seed", Scope::plane, "nodes of a block lie on its grid"},
    Scoped{"cloud.nodes", Scope::plane, "tetrahedra of a block stand on its grid"},
    Scoped{"cloud.nodes_file", Scope::plane, "tetrahedra of a block stand on its grid"},
    Scoped{"cloud.refine", Scope::plane, "the grid of a block has one spacing"},
    Scoped{"initial.spin", Scope::plane, "a rotation in space needs an axis"},
    Scoped{"initial.velocity_gradient", Scope::plane, "its components are those of the plane"},
    Scoped{"initial.imperfections", Scope::plane, "they lie along polylines of the plane"},
    Scoped{"periodic", Scope::plane, "sides are matched along lines"},
    Scoped{"tools.*.start", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.path", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.path[]", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.close", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.rectangle", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.drawing", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.circle", Scope::plane, "an outline bounds no tool in space; give its plane"},
    Scoped{"tools.*.rotate", Scope::plane, "a plane is turned by its normal"},
    Scoped{"tools.*.plane", Scope::space, "a tool in the plane has an outline, such as a rectangle"},
    Scoped{"tools.*.mass", Scope::plane, "a half-space has no mass to give"},
    Scoped{"tools.*.force", Scope::plane, "a half-space has no mass to push"},
    Scoped{"tools.*.initial_velocity", Scope::plane, "it is that of a tool with a mass; give its velocity"},
    Scoped{"tools.*.direction", Scope::plane, "it guides a tool with a mass"},
    Scoped{"tools.*.spring", Scope::plane, "it pushes a tool with a mass"},
    Scoped{"tools.*.damping", Scope::plane, "it slows a tool with a mass"},
    Scoped{"tools.*.equal_areas", Scope::plane, "a plane has no arcs"},
    Scoped{"tools.*.heat.section", Scope::plane, "a half-space has no outline to fill with nodes"},
    Scoped{"contact", Scope::plane, "faces that touch each other are found along outlines"},
    Scoped{"coolants", Scope::plane, "faces that a cut makes are of the plane"},
    Scoped{"adapt.cracks", Scope::plane, "broken matter in space parts where it goes through"},
    Scoped{"adapt.placement", Scope::plane, "nodes in space are put between others"},
    Scoped{"adapt.growth", Scope::plane, "clouds in space keep the spacing that they have"},
    Scoped{"adapt.tool_spacing", Scope::plane, "clouds in space keep the spacing that they have"},
    Scoped{"adapt.surface_spacing", Scope::plane, "clouds in space keep the spacing that they have"},
    Scoped{"adapt.rest_factor", Scope::plane, "clouds in space keep the spacing that they have"},
    Scoped{"adapt.indicator", Scope::plane, "clouds in space keep the spacing that they have"},
    Scoped{"adapt.window", Scope::plane, "ends of a window are cut through an outline"},
    Scoped{"method.cells", Scope::space, "cells in the plane are those of Voronoi"},
    Scoped{"fracture", Scope::plane, "a crack front in space is a line, not a tip"},
    Scoped{"output.pictures", Scope::plane, "pictures show the plane; fields.pvd shows space"},
    Scoped{"output.pictures_every", Scope::plane, "pictures show the plane; fields.pvd shows space"},
    Scoped{"output.drawing", Scope::plane, "there are no pictures of space to draw"},
    Scoped{"output.ranges", Scope::plane, "there are no pictures of space to colour"},
    Scoped{"output.picture_fields", Scope::plane, "pictures show the plane; fields.pvd shows space"},
    Scoped{"output.notes", Scope::plane, "there are no pictures of space to stand beside"},
    Scoped{"output.windows", Scope::plane, "there are no pictures of space to enlarge"},
    Scoped{"report.blanking", Scope::plane, "cuts are followed along the outline of the workpiece"},
    Scoped{"report.cutting", Scope::plane, "cuts are followed along the outline of the workpiece"},
    Scoped{"report.springback", Scope::plane, "bodies are let go in the plane only"},
    Scoped{"report.experiment", Scope::plane, "measured curves are laid over those of the plane alone"},
};

} // namespace

void add_block(Keys& k) {
  const std::string at = "domain.block.";
  k.add("domain.block", table, "The workpiece in space, on a structured grid of tetrahedra.").required();
  k.add(at + "shape", choice,
        "`box`: faces `x-`, `x+`, `y-`, `y+`, `z-`, `z+`. `cylinder`: about an axis along z, faces `bottom`, "
        "`top` and `side`, with the cuts `x-` and `y-` of a half and a quarter.")
      .one_of({"box", "cylinder"})
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
  k.add(at + "centre", vector, "Centre of the bottom of the cylinder.")
      .unit(d::length)
      .when("shape", {"cylinder"})
      .example("\"0 0 0 mm\"")
      .computed("0");
  k.add(at + "radius", quantity, "").unit(d::length).in(positive).required().when("shape", {"cylinder"});
  k.add(at + "length", quantity, "Along z.")
      .unit(d::length)
      .in(positive)
      .required()
      .when("shape", {"cylinder"});
  k.add(at + "part", choice,
        "What of the cylinder is there: all, the half with y > 0, or the quarter with x > 0 and y > 0, from "
        "its centre.")
      .one_of({"whole", "half", "quarter"})
      .fallback("\"whole\"")
      .when("shape", {"cylinder"});
}

void mark_scopes(Keys& k) {
  for (const Scoped& scoped : scopes) {
    const std::string path = scoped.path;
    for (Key& key : k.all)
      if (key.path == path || key.path.starts_with(path + ".")) {
        key.scope = scoped.scope;
        key.scope_reason = scoped.reason;
      }
  }
}

} // namespace cnem::input
