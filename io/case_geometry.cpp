// The geometric part of the case reader: domain, tools, cloud.
#include "io/case_parts.hpp"
#include "io/curve_checks.hpp"
#include "io/outline.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace cnem::io {
namespace {

/// The curve of a table; nothing, and a mistake recorded, when it cannot be made.
std::optional<Curve> outline(const Setting& table, const OutlineNames& names, Diagnostics& diagnostics) {
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

/// Names of the ends of a crack: given, or from where they lie.
std::array<std::string, 2> tip_names(const Setting& crack, const Setting& domain, Diagnostics& diagnostics) {
  if (const Setting* given = crack.find("tips")) {
    const auto& names = std::get<std::vector<std::string>>(given->value);
    if (names.size() == 2) return {names[0], names[1]};
    diagnostics.add(
        Mistake::type, given->where, given->path,
        fmt::format("found {} names, expected two such as {}", names.size(), given->key->example_text()));
    return {};
  }
  const std::vector<Vec2> path = crack_path(crack);
  if (path.size() < 2) return {};
  const Vec2 d = path.back() - path.front();
  const bool upright = std::abs(d.x()) <= 1e-9 * d.norm();
  const std::array<std::string, 2> sides =
      upright ? std::array<std::string, 2>{"bottom", "top"} : std::array<std::string, 2>{"left", "right"};
  const bool forward = upright ? d.y() > 0.0 : d.x() > 0.0;
  const std::string prefix = domain.entries("cracks").size() > 1 ? crack.name + "_" : "";
  return {prefix + sides[forward ? 0 : 1], prefix + sides[forward ? 1 : 0]};
}

/// Where a polyline crosses, touches or overlaps itself.
std::optional<Vec2> self_crossing(const std::vector<CurvePiece>& segments, double tolerance) {
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size(); ++j)
      for (const Vec2& x : meeting_points(segments[i], segments[j], tolerance))
        if (j > i + 1 || (x - segments[i].to).norm() > tolerance) return x;
  return std::nullopt;
}

std::vector<CurvePiece> segments_of(const Crack& crack) {
  std::vector<CurvePiece> segments;
  for (std::size_t i = 1; i < crack.points.size(); ++i)
    segments.push_back({crack.points[i - 1], crack.points[i], {0, 0}, 0.0, false, crack.name});
  return segments;
}

/// All boundary curves of a domain.
std::vector<std::pair<std::string, const Curve*>> curves_of(const Domain& domain) {
  std::vector<std::pair<std::string, const Curve*>> curves{{"domain.outer", &domain.outer}};
  for (const Hole& hole : domain.holes) curves.emplace_back("domain.holes." + hole.name, &hole.outline);
  return curves;
}

/// Why the point is not in the domain or on its boundary; empty when it is.
std::string outside_reason(const Domain& domain, const Vec2& x) {
  const double tolerance = 1e-9 * extent(domain.outer);
  if (!inside(domain.outer, x) && distance(domain.outer, x) > tolerance) return "outside domain.outer";
  for (const Hole& hole : domain.holes)
    if (inside(hole.outline, x) && distance(hole.outline, x) > tolerance)
      return "in the hole domain.holes." + hole.name;
  return "";
}

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

/// First thing wrong with the polyline of a crack; empty when nothing is. `culprit`: the point to blame.
std::string crack_problem(const Domain& domain, std::size_t index, std::size_t& culprit) {
  const Crack& crack = domain.cracks[index];
  const double tolerance = 1e-9 * extent(domain.outer);
  if (crack.points.size() < 2)
    return fmt::format("found {} points, expected at least two", crack.points.size());
  const std::vector<CurvePiece> segments = segments_of(crack);
  for (culprit = 1; culprit < crack.points.size(); ++culprit)
    if (segments[culprit - 1].length() <= tolerance)
      return fmt::format("two consecutive points coincide at {}, expected different ones",
                         show(crack.points[culprit]));
  for (culprit = 0; culprit < crack.points.size(); ++culprit)
    if (const std::string reason = outside_reason(domain, crack.points[culprit]); !reason.empty())
      return fmt::format("the point {} is {}, expected points of the domain", show(crack.points[culprit]),
                         reason);
  if (const auto point = self_crossing(segments, tolerance))
    return fmt::format("the crack crosses or touches itself at {}, expected a simple polyline", show(*point));
  for (const auto& [name, curve] : curves_of(domain))
    for (const CurvePiece& piece : curve->pieces)
      for (const CurvePiece& segment : segments)
        for (const Vec2& x : meeting_points(segment, piece, tolerance))
          if ((x - crack.points.front()).norm() > tolerance && (x - crack.points.back()).norm() > tolerance)
            return fmt::format("the crack meets {} at {}, expected only its ends to do so", name, show(x));
  for (std::size_t other = 0; other < index; ++other)
    for (const CurvePiece& a : segments)
      for (const CurvePiece& b : segments_of(domain.cracks[other]))
        if (const auto points = meeting_points(a, b, tolerance); !points.empty())
          return fmt::format("the crack meets domain.cracks.{} at {}, expected cracks apart",
                             domain.cracks[other].name, show(points.front()));
  return "";
}

/// Names of cracks and of their tips tell results and boundary pieces apart.
void check_crack_names(const Setting& table, const Domain& domain, Diagnostics& diagnostics) {
  std::map<std::string, std::string> owner_of_tip;
  for (std::size_t i = 0; i < domain.cracks.size(); ++i) {
    const Crack& crack = domain.cracks[i];
    const Setting& setting = table.entries("cracks")[i];
    for (const auto& [name, curve] : curves_of(domain))
      if (std::any_of(curve->pieces.begin(), curve->pieces.end(),
                      [&](const CurvePiece& piece) { return piece.name == crack.name; }))
        diagnostics.add(Mistake::conflict, setting.where, setting.path,
                        fmt::format("{} has a boundary piece of this name, expected another one", name));
    const Setting* tips = setting.find("tips");
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string& tip = crack.tips[end];
      const auto [found, is_new] = owner_of_tip.emplace(tip, crack.name);
      if (!is_new && !tip.empty())
        diagnostics.add(Mistake::conflict, tips ? tips->where_of(end) : setting.where, setting.path + ".tips",
                        fmt::format("the tip {} is one of crack '{}' already, expected different names",
                                    toml_quoted(tip), found->second));
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
  const double allowed = input.cloud.spacing > 0.0 ? 0.5 * input.cloud.spacing : 0.01 * size;
  if (deepest > allowed)
    diagnostics.add(
        Mistake::geometry, table.where, table.path,
        fmt::format("the tool lies {:.3g} m deep in the workpiece at {}, expected it outside at the "
                    "start",
                    deepest, show(where)));
}

} // namespace

std::vector<Vec2> crack_path(const Setting& table) {
  const Setting* points = table.find("points");
  std::vector<Vec2> path = points ? std::get<std::vector<Vec2>>(points->value) : std::vector<Vec2>{};
  if (const Setting* turn = table.find("rotate")) {
    const double angle = turn->get<double>("angle");
    const auto& centre = turn->get<Vec2>("centre");
    for (Vec2& x : path) {
      const Vec2 d = x - centre;
      x = centre + std::cos(angle) * d + std::sin(angle) * left_normal(d);
    }
  }
  return path;
}

void read_domain(const Setting& root, Case& result, Diagnostics& diagnostics) {
  const Setting& table = *root.find("domain");
  Domain& domain = result.domain;
  domain.material = table.get<std::string>("material");
  const auto outer = outline(*table.find("outer"), {"outer", true}, diagnostics);
  bool complete = outer.has_value();
  if (outer) domain.outer = *outer;
  for (const Setting& hole : table.entries("holes")) {
    const auto curve = outline(hole, {hole.name, false}, diagnostics);
    complete = complete && curve;
    if (curve) domain.holes.push_back({hole.name, curve->reversed()});
  }
  for (const Setting& crack : table.entries("cracks"))
    domain.cracks.push_back({crack.name, crack_path(crack), tip_names(crack, table, diagnostics)});
  check_crack_names(table, domain, diagnostics);
  if (!complete) return;
  if (result.analysis.kinematics == Analysis::Kinematics::axisymmetric)
    check_axis(*table.find("outer"), domain, diagnostics);
  if (const Setting* holes = table.find("holes")) check_holes(*holes, domain, diagnostics);
  for (std::size_t i = 0; i < domain.cracks.size(); ++i) {
    const Setting& points = *table.entries("cracks")[i].find("points");
    std::size_t culprit = 0;
    if (const std::string problem = crack_problem(domain, i, culprit); !problem.empty())
      diagnostics.add(Mistake::geometry, points.where_of(culprit), points.path, problem);
  }
  for (const Setting& line : root.entries("output.lines")) {
    for (const char* end : {"from", "to"}) {
      const Setting& at = *line.find(end);
      if (const std::string reason = outside_reason(domain, std::get<Vec2>(at.value)); !reason.empty())
        diagnostics.add(Mistake::geometry, at.where, at.path,
                        fmt::format("the point {} is {}, expected a material point",
                                    show(std::get<Vec2>(at.value)), reason));
    }
    const Setting& to = *line.find("to");
    if (line.get<Vec2>("from") == line.get<Vec2>("to"))
      diagnostics.add(
          Mistake::geometry, to.where, to.path,
          fmt::format("the line has no length, it begins and ends at {}, expected two different points",
                      show(line.get<Vec2>("to"))));
  }
  for (const Setting& probe : root.entries("output.probes")) {
    const Setting& at = *probe.find("at");
    const auto& point = std::get<Vec2>(at.value);
    if (const std::string reason = outside_reason(domain, point); !reason.empty())
      diagnostics.add(Mistake::geometry, at.where, at.path,
                      fmt::format("the probe at {} is {}, expected a material point", show(point), reason));
  }
}

void read_tools(const Setting& root, Case& result, Diagnostics& diagnostics) {
  for (const Setting& table : root.entries("tools")) {
    Tool tool;
    tool.name = table.name;
    tool.outline = outline(table, {table.name, false}, diagnostics).value_or(Curve{});
    if (!result.domain.outer.pieces.empty() && !tool.outline.pieces.empty())
      check_overlap(table, tool, result, diagnostics);
    const auto& velocity = table.get<VectorFunction>("velocity");
    for (std::size_t k = 0; k < 2; ++k) tool.velocity[k] = velocity[k].value_or(TimeTable(0.0));
    tool.friction.law = table.choice<Friction::Law>("friction.law");
    tool.friction.coefficient = table.maybe<double>("friction.coefficient").value_or(0.0);
    tool.friction.shear_factor = table.maybe<double>("friction.shear_factor").value_or(1.0);
    if (const Setting* heat = table.find("heat")) {
      if (!result.analysis.thermal)
        diagnostics.add(Mistake::conflict, heat->where, heat->path,
                        "found the thermal side of a tool, expected it with analysis.thermal = true only");
      ToolHeat& tool_heat = tool.heat.emplace();
      tool_heat.conductance = heat->get<double>("conductance");
      tool_heat.temperature = heat->get<double>("temperature");
      tool_heat.effusivity = heat->maybe<double>("effusivity");
      const auto k = heat->maybe<double>("conductivity"), density = heat->maybe<double>("density"),
                 c = heat->maybe<double>("specific_heat");
      const int parts = int(k.has_value()) + int(density.has_value()) + int(c.has_value());
      if (parts > 0 && (parts < 3 || tool_heat.effusivity))
        diagnostics.add(Mistake::conflict, heat->where, heat->path,
                        "expected either effusivity, or conductivity, density and specific_heat together");
      else if (parts == 3)
        tool_heat.effusivity = std::sqrt(*k * *density * *c);
    }
    result.tools.push_back(std::move(tool));
  }
}

} // namespace cnem::io
