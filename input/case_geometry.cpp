// The geometric part of the case reader: domain, tools, cloud.
#include "input/case_parts.hpp"
#include "input/case_walls.hpp"
#include "input/constants.hpp"
#include "input/curve_checks.hpp"
#include "input/fibres.hpp"
#include "input/outline.hpp"
#include "input/schema/nearest.hpp"
#include "input/space_domain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {

std::optional<Curve> read_outline(const Setting& table, const OutlineNames& names, Diagnostics& diagnostics) {
  try {
    return make_outline(table, names);
  } catch (const OutlineError& error) {
    const std::string key = error.key.empty() ? table.path : table.path + "." + error.key;
    // Elements of a list are "path[2]" in keys and two steps in the tree.
    std::string steps = error.key;
    if (const auto bracket = steps.find('['); bracket != std::string::npos) steps.insert(bracket, 1, '.');
    const Setting* culprit = table.find(steps);
    diagnostics.add(Mistake::geometry, culprit && culprit->given ? culprit->where : table.where, key,
                    error.what());
    return std::nullopt;
  }
}

namespace {

void check_holes(const Setting& holes, const Domain& domain, Diagnostics& diagnostics) {
  const auto fail = [&](std::size_t i, const std::string& message) {
    const Setting& setting = *holes.find(domain.holes[i].name);
    diagnostics.add(Mistake::geometry, setting.where, setting.path, message);
  };
  for (std::size_t i = 0; i < domain.holes.size(); ++i) {
    const Curve& hole = domain.holes[i].outline;
    if (const auto point = common_point(hole, domain.outer)) {
      fail(i, fmt::format("the hole meets domain.outer at {}, expected it to lie inside", show(*point)));
      continue;
    }
    if (!inside(domain.outer, hole.pieces.front().from))
      fail(i, fmt::format("the hole lies outside domain.outer at {}, expected it to lie inside",
                          show(hole.pieces.front().from)));
    for (std::size_t j = 0; j < i; ++j) {
      const Curve& other = domain.holes[j].outline;
      if (const auto point = common_point(hole, other))
        fail(i, fmt::format("the hole meets domain.holes.{} at {}, expected holes apart",
                            domain.holes[j].name, show(*point)));
      else if (inside(other, hole.pieces.front().from) || inside(hole, other.pieces.front().from))
        fail(i, fmt::format("one of the holes {} and {} lies in the other, expected holes apart",
                            domain.holes[i].name, domain.holes[j].name));
    }
  }
}

/// A body of revolution lies on one side of its axis.
void check_axis(const Setting& outer, const Domain& domain, Diagnostics& diagnostics) {
  double least = 0.0;
  for (const CurvePiece& piece : domain.outer.pieces)
    for (int k = 0; k < 16; ++k) least = std::min(least, piece.point(k / 16.0).x());
  if (least < -1e-9 * extent(domain.outer))
    diagnostics.add(Mistake::geometry, outer.where, outer.path,
                    fmt::format("found an outline that reaches to x = {:g} m, expected x >= 0: an "
                                "axisymmetric body turns about x = 0",
                                least));
}

/// How deep a point lies in the domain, m; 0 outside.
double depth_in(const Domain& domain, const Vec2& x) {
  if (!inside(domain.outer, x)) return 0.0;
  double depth = distance(domain.outer, x);
  for (const Hole& hole : domain.holes) {
    if (inside(hole.outline, x)) return 0.0;
    depth = std::min(depth, distance(hole.outline, x));
  }
  return depth;
}

/// The workpiece has no place where a tool is. Overlaps of less than half a spacing are left to contact,
/// which pushes the nodes out.
void check_overlap(const Setting& table, const Tool& tool, const Case& input, Diagnostics& diagnostics) {
  constexpr int samples = 16; // of each piece
  double deepest = 0.0;
  Vec2 where{0, 0};
  const auto look = [&](const Curve& curve, const auto& depth_at) {
    for (const CurvePiece& piece : curve.pieces)
      for (int k = 0; k < samples; ++k) {
        const Vec2 x = piece.point(double(k) / samples);
        const double depth = depth_at(x);
        if (depth > deepest) deepest = depth, where = x;
      }
  };
  look(tool.outline, [&](const Vec2& x) { return depth_in(input.domain, x); });
  for (const auto& [name, curve] : curves_of(input.domain))
    look(*curve, [&](const Vec2& x) { return inside(tool.outline, x) ? distance(tool.outline, x) : 0.0; });
  const double size = extent(input.domain.outer);
  const double rounding = 1e-9 * size;
  const double allowed =
      input.cloud.spacing > 0.0 ? std::max(0.5 * input.cloud.spacing, rounding) : 0.01 * size;
  if (deepest > allowed)
    diagnostics.add(
        Mistake::geometry, table.where, table.path,
        fmt::format("the tool lies {:.3g} m deep in the workpiece at {}, expected it outside at the "
                    "start",
                    deepest, show(where)));
}

} // namespace

namespace {

/// Probes and lines lie in the workpiece.
void check_points(const Setting& root, const Domain& domain, Diagnostics& diagnostics) {
  const auto check = [&](const Setting& at, const Vec3& point, const char* what) {
    const Vec2 in_plane = point.head<2>();
    const std::string reason =
        domain.in_space() ? outside_reason_in_space(domain, point) : outside_reason(domain, in_plane);
    if (!reason.empty())
      diagnostics.add(Mistake::geometry, at.where, at.path,
                      fmt::format("the {} {} is {}, expected a material point", what,
                                  domain.in_space() ? show(point) : show(in_plane), reason));
  };
  for (const Setting& line : root.entries("output.lines")) {
    const Vec3 from = line.vector("from"), to = line.vector("to");
    check(*line.find("from"), from, "point");
    check(*line.find("to"), to, "point");
    if (const Setting& end = *line.find("to"); from == to)
      diagnostics.add(
          Mistake::geometry, end.where, end.path,
          fmt::format("the line has no length, it begins and ends at {}, expected two different points",
                      domain.in_space() ? show(to) : show(Vec2(to.head<2>()))));
  }
  for (const Setting& probe : root.entries("output.probes"))
    check(*probe.find("at"), probe.vector("at"), "probe at");
}

} // namespace

namespace {

/// Whether a workpiece in space is described in one way.
bool one_body(const Setting& table, Diagnostics& diagnostics) {
  const bool outer = table.find("outer"), sweep = table.find("extrude") || table.find("revolve");
  const int ways = int(table.find("block") != nullptr) + int(table.find("stl") != nullptr) +
                   int(table.find("extrude") != nullptr) + int(table.find("revolve") != nullptr);
  if (ways == 1 && outer == sweep) return true;
  const Mistake kind = ways > 1 || (ways == 1 && outer) ? Mistake::conflict : Mistake::missing_key;
  diagnostics.add(kind, table.where, table.path,
                  ways == 0
                      ? "found no body in space, expected block, stl, or an outline (outer) with extrude or "
                        "revolve"
                  : ways > 1 ? "found several of block, stl, extrude and revolve, expected one"
                  : outer ? "found an outline beside block or stl, expected it with extrude or revolve only"
                          : "found no outline to extrude or revolve, expected outer or drawing");
  return false;
}

} // namespace

void read_domain(Setting& root, Case& result, Diagnostics& diagnostics) {
  Setting& table = *root.find("domain");
  Domain& domain = result.domain;
  domain.material = table.get<std::string>("material");
  const Setting* block = table.find("block");
  Setting* file = table.find("stl");
  const Setting *extrude = table.find("extrude"), *revolve = table.find("revolve");
  if (result.analysis.dimensions() == 3 && !one_body(table, diagnostics)) return;
  if (block) domain.block = read_block(*block, diagnostics);
  if (file) read_faceted(*file, result, diagnostics);
  if (block || file) return domain.in_space() ? check_points(root, domain, diagnostics) : void();
  if (extrude) domain.sweep = read_extrusion(*extrude, diagnostics);
  if (revolve) domain.sweep = read_revolution(*revolve, diagnostics);
  const auto outer = read_outline(*table.find("outer"), {"outer", true}, diagnostics);
  bool complete = outer.has_value();
  if (outer) domain.outer = *outer;
  for (const Setting& hole : table.entries("holes")) {
    const auto curve = read_outline(hole, {hole.name, false}, diagnostics);
    complete = complete && curve;
    if (curve) domain.holes.push_back({hole.name, curve->reversed()});
  }
  read_walls(table, domain, diagnostics);
  if (!complete) return;
  read_fibres(root, domain, diagnostics);
  if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric || revolve)
    check_axis(*table.find("outer"), domain, diagnostics);
  if (const Setting* holes = table.find("holes")) check_holes(*holes, domain, diagnostics);
  check_walls(table, domain, diagnostics);
  check_points(root, domain, diagnostics);
}

namespace {

contact::Friction read_friction(const Setting& table, Diagnostics& diagnostics) {
  contact::Friction friction =
      read_law<contact::Friction>(contact::FrictionLaws{}, table, diagnostics).value_or(contact::Friction());
  contact::FrictionMelting melting;
  read_constants(contact::FrictionMelting::parameters, table, melting);
  friction.set_melting(melting);
  return friction;
}

/// Where friction differs between materials.
void read_friction_by_material(const Setting& table, const Setting& root, Tool& tool,
                               Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const Setting& material : root.entries("materials")) known.push_back(material.name);
  for (const Setting& one : table.entries("by_material")) {
    if (std::find(known.begin(), known.end(), one.name) == known.end())
      diagnostics.add(Mistake::reference, one.where, one.path,
                      fmt::format("found \"{}\", expected one of the materials: {}{}", one.name,
                                  fmt::join(known, ", "), did_you_mean(one.name, known)));
    contact::Friction friction = tool.friction;
    if (!friction.set_coefficient(one.get<double>("coefficient"))) {
      diagnostics.add(Mistake::conflict, one.where, one.path,
                      fmt::format("found friction by material with law = \"{}\", expected a law with one "
                                  "coefficient such as \"coulomb\"",
                                  table.get<std::string>("law")));
      return;
    }
    tool.friction_on[one.name] = friction;
  }
}

} // namespace

void read_contact(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("contact");
  result.contact = {table.get<bool>("deformable"), read_friction(*table.find("friction"), diagnostics),
                    table.get<double>("conductance")};
  const Setting& conductance = *table.find("conductance");
  if (result.contact.conductance > 0.0 && !result.contact.active)
    diagnostics.add(Mistake::conflict, conductance.where, conductance.path,
                    "found a conductance between parts that pass through each other, expected it with "
                    "contact.deformable = true only");
  else if (result.contact.conductance > 0.0 && !result.analysis.thermal)
    diagnostics.add(Mistake::conflict, conductance.where, conductance.path,
                    "found a conductance in an analysis without heat, expected it with "
                    "analysis.thermal = true only");
  const Setting& law = *table.find("friction.law");
  if (!result.contact.active && std::get<std::string>(law.value) != "none")
    diagnostics.add(Mistake::conflict, law.where, law.path,
                    "found friction between parts that pass through each other, expected it with "
                    "contact.deformable = true only");
}

void read_tools(Setting& root, Case& result, Diagnostics& diagnostics) {
  Setting* tools = root.find("tools");
  if (!tools) return;
  for (Setting& table : tools->members) {
    Tool tool;
    tool.name = table.name;
    if (result.analysis.dimensions() == 3)
      tool.solid = read_solid(table, result, diagnostics);
    else
      tool.outline = read_outline(table, {table.name, false}, diagnostics).value_or(Curve{});
    if (!result.domain.outer.pieces.empty() && !tool.outline.pieces.empty())
      check_overlap(table, tool, result, diagnostics);
    tool.velocity = table.maybe<VectorFunction>("velocity").value_or(VectorFunction{});
    read_drive(table, result, tool, diagnostics);
    tool.friction = read_friction(*table.find("friction"), diagnostics);
    read_friction_by_material(*table.find("friction"), root, tool, diagnostics);
    tool.response = read_law<contact::Response>(contact::Responses{}, *table.find("response"), diagnostics)
                        .value_or(contact::Response());
    tool.equal_areas = table.maybe<bool>("equal_areas").value_or(false);
    read_tool_heat(table, root, result, tool, diagnostics);
    result.tools.push_back(std::move(tool));
  }
}

} // namespace cnem::input
