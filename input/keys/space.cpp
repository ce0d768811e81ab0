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
    Scoped{"adapt", Scope::plane, "nodes are put into Voronoi cells of the plane"},
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

/// Outlines of tools, and what lies below these keys: of a plane, also where the tool is in space.
constexpr std::array flat{"tools.*.start",  "tools.*.path",    "tools.*.rectangle", "tools.*.circle",
                          "tools.*.rotate", "tools.*.drawing", "tools.*.profile"};

bool below(const std::string& key, const std::string& path) {
  return key == path || key.starts_with(path + ".") || key.starts_with(path + "[");
}

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
  for (Key& key : k.all)
    key.flat = std::any_of(flat.begin(), flat.end(), [&](const char* path) { return below(key.path, path); });
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
