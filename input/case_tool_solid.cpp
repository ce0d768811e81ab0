// What bounds a tool in space, of the case reader.
#include "input/case_parts.hpp"
#include "input/curve_checks.hpp"
#include "input/triangle_file.hpp"

#include <array>
#include <fmt/format.h>

namespace cnem::input {
namespace {

using Shape = ToolSolid::Shape;

constexpr const char* outline_keys[] = {"start", "path", "rectangle", "circle", "drawing", "rotate"};

bool has_outline(const Setting& table) {
  return std::ranges::any_of(outline_keys, [&](const char* key) { return table.find(key) != nullptr; });
}

Plane read_plane(const Setting& table, Diagnostics& diagnostics) {
  const Setting& normal = *table.find("normal");
  if (!(table.vector("normal").norm() > 0.0))
    diagnostics.add(Mistake::range, normal.where, normal.path,
                    "found no direction, expected one such as \"0 0 1\"");
  return {table.vector("at"), table.vector("normal")};
}

void read_box(const Setting& table, ToolSolid& solid, Diagnostics& diagnostics) {
  const Vec3 from = table.vector("from"), to = table.vector("to");
  solid.box = {from.cwiseMin(to), from.cwiseMax(to)};
  const Setting& key = *table.find("to");
  if (!((to - from).cwiseAbs().minCoeff() > 0.0))
    diagnostics.add(Mistake::geometry, key.where, key.path,
                    fmt::format("a box from {} to {} has no volume, expected two opposite corners such as {}",
                                show(from), show(to), key.key->example_text()));
}

void read_ends(const Setting& table, ToolSolid& solid, Diagnostics& diagnostics) {
  const Setting* extrude = table.find("extrude");
  if (!extrude) return;
  solid.low = extrude->maybe<double>("from");
  solid.high = extrude->maybe<double>("to");
  solid.radius_low = extrude->get<double>("edge_from");
  solid.radius_high = extrude->get<double>("edge_to");
  if (solid.low && solid.high && !(*solid.low < *solid.high))
    diagnostics.add(
        Mistake::geometry, extrude->find("to")->where, extrude->find("to")->path,
        fmt::format("found {:.6g} m, expected an end beyond `from`, {:.6g} m", *solid.high, *solid.low));
  for (const auto& [end, radius] : {std::pair{"from", "edge_from"}, std::pair{"to", "edge_to"}})
    if (const Setting& edge = *extrude->find(radius); edge.given && !extrude->find(end))
      diagnostics.add(Mistake::missing_key, edge.where, edge.path,
                      fmt::format("found the edge of an end that is not there, expected {}.{} beside it",
                                  extrude->path, end));
}

void read_place(const Setting& table, ToolSolid& solid, Diagnostics& diagnostics) {
  const Setting* place = table.find("place");
  if (!place) return;
  if (solid.shape == Shape::half_space)
    diagnostics.add(Mistake::conflict, place->where, place->path,
                    "found the place of a half-space, expected its plane alone");
  if (place->find("at")) solid.at = place->vector("at");
  solid.turn = place->get<double>("turn");
  const Setting* axis = place->find("axis");
  if (!axis) return;
  solid.axis = place->vector("axis");
  if (!(solid.axis.norm() > 0.0))
    diagnostics.add(Mistake::range, axis->where, axis->path,
                    "found no direction, expected one such as \"0 1 0\"");
}

} // namespace

ToolSolid read_solid(Setting& table, const Case& input, Diagnostics& diagnostics) {
  ToolSolid solid;
  solid.shape = table.choice<Shape>("shape");
  const bool outlined =
      solid.shape == Shape::extruded || solid.shape == Shape::revolved || solid.shape == Shape::swept;
  if (outlined) {
    solid.outline = read_outline(table, {table.name, false}, diagnostics).value_or(Curve{});
  } else if (has_outline(table)) {
    for (const char* key : outline_keys)
      if (const Setting* found = table.find(key))
        diagnostics.add(Mistake::conflict, found->where, found->path,
                        fmt::format("found an outline of a tool with shape = \"{}\", expected it with "
                                    "\"extruded\", \"revolved\" or \"swept\"",
                                    table.get<std::string>("shape")));
  }
  if (const Setting* plane = table.find("plane")) solid.plane = read_plane(*plane, diagnostics);
  if (const Setting* box = table.find("box")) read_box(*box, solid, diagnostics);
  read_ends(table, solid, diagnostics);
  if (const Setting* profile = table.find("profile"))
    solid.profile = read_outline(*profile, {table.name, false}, diagnostics).value_or(Curve{});
  if (Setting* stl = table.find("stl")) {
    solid.soup = read_triangles(*stl, input.path, diagnostics).value_or(FacetSoup{});
    solid.file = stl->get<std::string>("file");
  }
  read_place(table, solid, diagnostics);
  return solid;
}

} // namespace cnem::input
