#include "input/case_walls.hpp"

#include "core/error.hpp"
#include "input/constants.hpp"
#include "input/curve_checks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace cnem::input {

namespace {

/// What cracks and interfaces have in common.
struct Wall {
  const char* what;         ///< "crack"
  std::string key;          ///< "domain.cracks.main"
  std::vector<Vec2> points; ///< m
  bool divides;             ///< has to run from boundary to boundary
  const Setting* setting;   ///< its key `points`
};

std::vector<Wall> walls_of(const Setting& table, const Domain& domain) {
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < domain.cracks.size(); ++i)
    walls.push_back({"crack", "domain.cracks." + domain.cracks[i].name, domain.cracks[i].path, false,
                     table.entries("cracks")[i].find("points")});
  const std::vector<Setting>& interfaces = table.entries("interfaces");
  for (std::size_t i = 0; i < domain.interfaces.size(); ++i) {
    const Interface& one = domain.interfaces[i];
    const bool own = i < interfaces.size(); // else of a fibre
    const std::string key = one.key.substr(std::string("domain.").size());
    walls.push_back({own ? "interface" : "face of a fibre", own ? one.key : one.key + " (" + one.name + ")",
                     one.path, true, own ? interfaces[i].find("points") : table.find(key + ".centre")});
  }
  return walls;
}

/// Names of the ends of a crack: given, or from where they lie.
std::array<std::string, 2> tip_names(const Setting& crack, const Setting& domain, Diagnostics& diagnostics) {
  if (const Setting* given = crack.find("tips")) {
    const auto& names = std::get<std::vector<std::string>>(given->value);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!valid_name(names[i]))
        diagnostics.add(Mistake::type, given->where_of(i), given->path,
                        fmt::format("found {}, expected a name of at most {} letters, digits, '_' and '-'",
                                    toml_quoted(shortened(names[i])), longest_name));
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
std::optional<Vec2> wall_crossing(const std::vector<CurvePiece>& segments, double tolerance) {
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (std::size_t j = i + 1; j < segments.size(); ++j)
      for (const Vec2& x : meeting_points(segments[i], segments[j], tolerance))
        if (j > i + 1 || (x - segments[i].to).norm() > tolerance) return x;
  return std::nullopt;
}

std::vector<CurvePiece> segments_of(const std::vector<Vec2>& points) {
  std::vector<CurvePiece> segments;
  for (std::size_t i = 1; i < points.size(); ++i)
    segments.push_back({points[i - 1], points[i], {0, 0}, 0.0, false, ""});
  return segments;
}

/// First thing wrong with a wall; empty when nothing is. `culprit`: the point to blame.
std::string problem_of(const Domain& domain, const std::vector<Wall>& walls, std::size_t index,
                       std::size_t& culprit) {
  const Wall& wall = walls[index];
  const double tolerance = 1e-9 * extent(domain.outer);
  if (wall.points.size() < 2)
    return fmt::format("found {} points, expected at least two", wall.points.size());
  const std::vector<CurvePiece> segments = segments_of(wall.points);
  for (culprit = 1; culprit < wall.points.size(); ++culprit)
    if (segments[culprit - 1].length() <= tolerance)
      return fmt::format("two consecutive points coincide at {}, expected different ones",
                         show(wall.points[culprit]));
  for (culprit = 0; culprit < wall.points.size(); ++culprit)
    if (const std::string reason = outside_reason(domain, wall.points[culprit]); !reason.empty())
      return fmt::format("the point {} is {}, expected points of the domain", show(wall.points[culprit]),
                         reason);
  if (const auto point = wall_crossing(segments, tolerance))
    return fmt::format("the {} crosses or touches itself at {}, expected a simple polyline", wall.what,
                       show(*point));
  const auto curves = curves_of(domain);
  for (const auto& [name, curve] : curves)
    for (const CurvePiece& piece : curve->pieces)
      for (const CurvePiece& segment : segments)
        for (const Vec2& x : meeting_points(segment, piece, tolerance))
          if ((x - wall.points.front()).norm() > tolerance && (x - wall.points.back()).norm() > tolerance)
            return fmt::format("the {} meets {} at {}, expected only its ends to do so", wall.what, name,
                               show(x));
  for (std::size_t other = 0; other < index; ++other)
    for (const CurvePiece& a : segments)
      for (const CurvePiece& b : segments_of(walls[other].points))
        if (const auto points = meeting_points(a, b, tolerance); !points.empty())
          return fmt::format("the {} meets {} at {}, expected them apart", wall.what, walls[other].key,
                             show(points.front()));
  if (wall.divides)
    for (const Vec2& end : {wall.points.front(), wall.points.back()})
      if (std::none_of(curves.begin(), curves.end(),
                       [&](const auto& curve) { return distance(*curve.second, end) <= tolerance; }))
        return fmt::format("the end {} lies inside, expected both ends on the boundary", show(end));
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

} // namespace

std::vector<std::pair<std::string, const Curve*>> curves_of(const Domain& domain) {
  std::vector<std::pair<std::string, const Curve*>> curves{{"domain.outer", &domain.outer}};
  for (const Hole& hole : domain.holes) curves.emplace_back("domain.holes." + hole.name, &hole.outline);
  return curves;
}

std::string outside_reason(const Domain& domain, const Vec2& x) {
  const double tolerance = 1e-9 * extent(domain.outer);
  if (!inside(domain.outer, x) && distance(domain.outer, x) > tolerance) return "outside domain.outer";
  for (const Hole& hole : domain.holes)
    if (inside(hole.outline, x) && distance(hole.outline, x) > tolerance)
      return "in the hole domain.holes." + hole.name;
  return "";
}

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

void read_cohesive(const Setting& table, Interface& interface, Diagnostics& diagnostics) {
  plasticity::CohesiveLaw law;
  read_constants(plasticity::CohesiveLaw::parameters, table, law);
  try {
    law.complete();
  } catch (const InputError& error) {
    diagnostics.add(Mistake::range, table.where, table.path, error.what());
  }
  interface.cohesive = law;
  const Setting* open = table.find("open");
  if (!open) return;
  interface.open = std::get<std::vector<Vec2>>(open->value);
  if (interface.open.size() != 2)
    diagnostics.add(Mistake::type, open->where, open->path,
                    fmt::format("found {} points, expected two such as {}", interface.open.size(),
                                open->key->example_text()));
}

void read_walls(const Setting& table, Domain& domain, Diagnostics& diagnostics) {
  for (const Setting& crack : table.entries("cracks"))
    domain.cracks.push_back({{crack.name, crack_path(crack)}, tip_names(crack, table, diagnostics)});
  check_crack_names(table, domain, diagnostics);
  for (const Setting& interface : table.entries("interfaces")) {
    for (const Crack& crack : domain.cracks)
      if (crack.name == interface.name)
        diagnostics.add(Mistake::conflict, interface.where, interface.path,
                        fmt::format("found the name of a crack, expected another name than {}", crack.name));
    domain.interfaces.push_back({{interface.name, interface.get<std::vector<Vec2>>("points")},
                                 interface.maybe<double>("conductance"),
                                 {},
                                 {},
                                 interface.path});
    if (const Setting* cohesive = interface.find("cohesive"))
      read_cohesive(*cohesive, domain.interfaces.back(), diagnostics);
  }
}

void check_walls(const Setting& table, const Domain& domain, Diagnostics& diagnostics) {
  const std::vector<Wall> walls = walls_of(table, domain);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    std::size_t culprit = 0;
    if (const std::string problem = problem_of(domain, walls, i, culprit); !problem.empty())
      diagnostics.add(Mistake::geometry, walls[i].setting->where_of(culprit), walls[i].setting->path,
                      problem);
  }
}

} // namespace cnem::input
