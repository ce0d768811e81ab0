#include "input/space_domain.hpp"

#include "clouds/space/facet_tree.hpp"
#include "clouds/space/faceted.hpp"
#include "input/case_parts.hpp"
#include "input/case_walls.hpp"
#include "input/curve_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cnem::input {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

using Part = Block::Part;

CurvePiece segment(const Vec2& from, const Vec2& to, const std::string& name) {
  return {from, to, {0, 0}, 0.0, false, name};
}

CurvePiece arc(const Vec2& from, const Vec2& to, const Vec2& centre, double radius, bool clockwise,
               const std::string& name) {
  return {from, to, centre, radius, clockwise, name};
}

double angle_of(const Block& block) {
  switch (block.part) {
  case Part::whole:
    return full_turn;
  case Part::half:
    return 0.5 * full_turn;
  case Part::sector:
    return block.angle;
  default:
    return 0.25 * full_turn;
  }
}

/// Names of the cuts at θ = 0 and at the end of a part.
std::array<std::string, 2> cuts_of(const Block& block) {
  if (block.part == Part::half) return {"y-", "y-"};
  if (block.part == Part::sector) return {"theta-", "theta+"};
  return {"y-", "x-"};
}

clouds::Extrusion box_of(const Block& block) {
  const auto [low, high] = block.bounds();
  const std::array<Vec2, 4> corner{
      {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}};
  constexpr std::array names{"y-", "x+", "y+", "x-"};
  clouds::Extrusion shape{{}, low.z(), high.z()};
  for (std::size_t k = 0; k < 4; ++k)
    shape.outline.outer.pieces.push_back(segment(corner[k], corner[(k + 1) % 4], names[k]));
  return shape;
}

clouds::Extrusion cylinder_of(const Block& block) {
  clouds::Extrusion shape{{}, block.centre.z(), block.centre.z() + block.length, "bottom", "top"};
  const Vec2 centre = block.centre.head<2>();
  const auto at = [&](double radius, double angle) {
    return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  const auto circle = [&](double radius, bool clockwise, const std::string& name) {
    const Vec2 right = centre + Vec2(radius, 0), left = centre - Vec2(radius, 0);
    return Curve{{arc(right, left, centre, radius, clockwise, name),
                  arc(left, right, centre, radius, clockwise, name)}};
  };
  const double outer = block.radius, inner = block.inner_radius, angle = angle_of(block);
  if (block.part == Part::whole) {
    shape.outline.outer = circle(outer, false, "side");
    if (inner > 0.0) shape.outline.holes = {circle(inner, true, "inside")};
    return shape;
  }
  const auto [low, high] = cuts_of(block);
  auto& pieces = shape.outline.outer.pieces;
  pieces.push_back(segment(at(inner, 0.0), at(outer, 0.0), low));
  const auto round = [&](double radius, double from, double to, const std::string& name) {
    const int count = std::abs(to - from) > 0.5 * full_turn ? 2 : 1;
    for (int k = 0; k < count; ++k)
      pieces.push_back(arc(at(radius, from + (to - from) * k / count),
                           at(radius, from + (to - from) * (k + 1) / count), centre, radius, to < from,
                           name));
  };
  round(outer, 0.0, angle, "side");
  pieces.push_back(segment(at(outer, angle), at(inner, angle), high));
  if (inner > 0.0) round(inner, angle, 0.0, "inside");
  return shape;
}

clouds::Revolution sphere_of(const Block& block) {
  const bool cut = block.part == Part::eighth; // by z = 0, too
  const double outer = block.radius, inner = block.inner_radius;
  auto [low, high] = cuts_of(block);
  clouds::Revolution shape{{}, block.centre, angle_of(block), low, high};
  auto& pieces = shape.profile.outer.pieces;
  const auto end = [&](double radius) { return cut ? Vec2(radius, 0.0) : Vec2(0.0, -radius); };
  pieces.push_back(segment(end(inner), end(outer), cut ? "z-" : "axis"));
  pieces.push_back(arc(end(outer), {0.0, outer}, {0, 0}, outer, false, "side"));
  pieces.push_back(segment({0.0, outer}, {0.0, inner}, "axis"));
  if (inner > 0.0)
    pieces.push_back(arc({0.0, inner}, end(inner), {0, 0}, inner, true, "inside"));
  else if (!cut) // one edge along the axis
    pieces = {pieces[1], segment({0.0, outer}, {0.0, -outer}, "axis")};
  return shape;
}

clouds::SpaceDomain body_of(const Block& block) {
  if (block.shape == Block::Shape::box) return box_of(block);
  if (block.shape == Block::Shape::cylinder) return cylinder_of(block);
  return sphere_of(block);
}

bool on_axis(const CurvePiece& piece, double size) {
  return !piece.is_arc() && std::max(std::abs(piece.from.x()), std::abs(piece.to.x())) <= 1e-9 * size;
}

/// Whether all pieces of a name are segments along one direction; `level`: along x.
bool one_direction(const clouds::DomainShape& shape, const std::string& name, bool level) {
  std::optional<Vec2> direction;
  if (level) direction = Vec2(1, 0);
  const auto fits = [&](const Curve& curve) {
    return std::ranges::all_of(curve.pieces, [&](const CurvePiece& piece) {
      if (piece.name != name) return true;
      if (piece.is_arc()) return false;
      if (!direction) direction = piece.tangent(0.0);
      return std::abs(cross(*direction, piece.tangent(0.0))) <= 1e-9;
    });
  };
  return fits(shape.outer) && std::ranges::all_of(shape.holes, fits);
}

} // namespace

clouds::SpaceDomain space_domain(const Domain& domain) {
  if (domain.block) return body_of(*domain.block);
  if (domain.faceted) return *domain.faceted;
  clouds::DomainShape shape;
  shape.outer = domain.outer;
  for (const Hole& hole : domain.holes) shape.holes.push_back(hole.outline);
  const Sweep& sweep = *domain.sweep;
  if (sweep.turned) return clouds::Revolution{shape, sweep.origin, sweep.angle, sweep.ends[0], sweep.ends[1]};
  return clouds::Extrusion{shape, sweep.from, sweep.to, sweep.ends[0], sweep.ends[1]};
}

std::vector<std::string> pieces_of(const clouds::SpaceDomain& domain) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  const auto add_shape = [&](const clouds::DomainShape& shape, bool turned) {
    const double size = extent(shape.outer);
    const auto add_curve = [&](const Curve& curve) {
      for (const CurvePiece& piece : curve.pieces)
        if (!turned || !on_axis(piece, size)) add(piece.name);
    };
    add_curve(shape.outer);
    std::ranges::for_each(shape.holes, add_curve);
  };
  if (const auto* extrusion = std::get_if<clouds::Extrusion>(&domain)) {
    add_shape(extrusion->outline, false);
    add(extrusion->low);
    add(extrusion->high);
  } else if (const auto* revolution = std::get_if<clouds::Revolution>(&domain)) {
    add_shape(revolution->profile, true);
    if (revolution->angle < full_turn * (1.0 - 1e-12)) {
      add(revolution->low);
      add(revolution->high);
    }
  }
  return names;
}

bool is_plane(const Domain& domain, const std::string& piece) {
  if (domain.faceted) {
    const auto found = std::ranges::find(domain.faceted_pieces, piece);
    return found < domain.faceted_pieces.begin() + static_cast<std::ptrdiff_t>(domain.plane_pieces);
  }
  if (domain.block) return piece != "side" && piece != "inside";
  const clouds::SpaceDomain body = space_domain(domain);
  if (const auto* extrusion = std::get_if<clouds::Extrusion>(&body)) {
    const bool end = piece == extrusion->low || piece == extrusion->high;
    const auto names = pieces_of(clouds::Extrusion{extrusion->outline, 0.0, 1.0, "", ""});
    const bool side = std::ranges::find(names, piece) != names.end();
    return end != side && (end || one_direction(extrusion->outline, piece, false));
  }
  const auto& revolution = std::get<clouds::Revolution>(body);
  const bool low = piece == revolution.low, high = piece == revolution.high;
  if (low && high) return std::abs(revolution.angle - 0.5 * full_turn) < 1e-9;
  const auto names = pieces_of(clouds::Revolution{revolution.profile, {0, 0, 0}, full_turn, "", ""});
  const bool side = std::ranges::find(names, piece) != names.end();
  return (low || high) != side && (!side || one_direction(revolution.profile, piece, true));
}

std::array<Vec3, 2> space_bounds(const Domain& domain) {
  if (domain.block) return domain.block->bounds();
  if (domain.faceted) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
    for (const auto& triangle : domain.faceted->soup.triangles)
      for (const Vec3& x : triangle.corner) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    return {low, high};
  }
  const Sweep& sweep = *domain.sweep;
  const auto around = bounds(domain.outer);
  const Vec2 &low = around[0], &high = around[1];
  if (!sweep.turned) return {Vec3(low.x(), low.y(), sweep.from), Vec3(high.x(), high.y(), sweep.to)};
  Vec2 from = high.x() * Vec2::Ones(), to = -from; // of the sector around the profile
  const auto reach = [&](const Vec2& direction) {
    for (const double radius : {low.x(), high.x()}) {
      from = from.cwiseMin(radius * direction);
      to = to.cwiseMax(radius * direction);
    }
  };
  reach({1, 0});
  reach({std::cos(sweep.angle), std::sin(sweep.angle)});
  const std::array<Vec2, 3> quarters{Vec2(0, 1), Vec2(-1, 0),
                                     Vec2(0, -1)}; // where it reaches furthest along an axis
  for (std::size_t k = 0; k < quarters.size(); ++k)
    if (sweep.angle > 0.25 * full_turn * static_cast<double>(k + 1)) reach(quarters[k]);
  return {sweep.origin + Vec3(from.x(), from.y(), low.y()), sweep.origin + Vec3(to.x(), to.y(), high.y())};
}

std::string outside_reason_in_space(const Domain& domain, const Vec3& x) {
  if (domain.block) return outside_reason(*domain.block, x);
  const auto [low, high] = space_bounds(domain);
  const double tolerance = 1e-9 * (high - low).norm();
  if (((x - low).array() < -tolerance).any() || ((high - x).array() < -tolerance).any())
    return "outside the workpiece";
  if (domain.faceted) {
    const clouds::FacetTree tree(clouds::divided_surface(*domain.faceted));
    return tree.nearest(x, std::numeric_limits<double>::max()).distance >= -tolerance ? ""
                                                                                      : "outside domain.stl";
  }
  const Sweep& sweep = *domain.sweep;
  if (!sweep.turned) return outside_reason(domain, Vec2(x.head<2>()));
  const Vec3 local = x - sweep.origin;
  const double radius = local.head<2>().norm();
  double angle = radius > 0.0 ? std::atan2(local.y(), local.x()) : 0.0;
  if (angle < -1e-9) angle += full_turn;
  if (angle > sweep.angle + 1e-9) return "outside the angle of domain.revolve";
  return outside_reason(domain, Vec2(radius, local.z()));
}

} // namespace cnem::input
