#pragma once
// Convex ridges of tools: corners and edges, sharp or rounded, that may pass between nodes of the workpiece.
#include "core/geometry/box.hpp"
#include "core/vec.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <vector>

namespace cnem::contact {

inline constexpr double full_turn = 2.0 * std::numbers::pi; ///< rad

using cnem::Box;

/// A convex ridge of a tool, sharp or rounded, that may pass between nodes of the workpiece.
template<int dim> struct Ridge;

/// In 2D: a circular arc of outward normals from `first`, turning counter-clockwise by `angle`.
template<> struct Ridge<2> {
  Vec2 centre{0, 0};   ///< m
  double radius = 0.0; ///< m, 0 for a sharp corner
  Vec2 first{0, 0};    ///< –, outward normal where the ridge begins
  double angle = 0.0;  ///< rad, in (0, 2π]

  /// Is the unit vector n among the outward normals, to a tolerance of 1e-6 rad?
  bool faces(const Vec2& n) const;
  /// The point of the ridge that reaches furthest along the unit vector n, which it faces.
  Vec2 extreme(const Vec2& n) const { return centre + radius * n; }
  /// How far a chord of length l with both ends on the ridge lies inside the tool, m; never more than the
  /// whole ridge allows, so that it vanishes with the radius.
  double sagitta(double l) const;
  /// m, of a point from the arc, on either side.
  double distance(const Vec2& x) const;
  /// How far an edge of length l meets the ridge as a corner: 0 where it is no longer than the chord of the
  /// whole arc, 1 from twice that on, smooth between.
  double sharpness(double l) const;
};

/// 0 up to x = 0, 1 from x = 1 on, with continuous slope.
inline double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// In space: along a straight line or a circle, with normals that are those of a section across it; or a
/// corner, where flat faces meet. What is on a ridge at `along` from its start is at
/// origin + p.x u + p.y v + along v×u (straight: along in m), or that of along = 0 turned about the axis v
/// through the origin (circular: along in rad; u turns towards v×u).
template<> struct Ridge<3> {
  enum class Path : std::int8_t { straight, circular, corner };
  Path path = Path::straight;
  Ridge<2> section;            ///< in the frame (u, v)
  Vec3 origin{0, 0, 0};        ///< m; of a corner the corner itself
  Vec3 u{1, 0, 0}, v{0, 0, 1}; ///< –, orthonormal; at the start
  double length = 0.0;         ///< m; circular: rad, in (0, 2π]
  std::vector<Vec3> cone = {}; ///< –, of a corner: outward normals of its faces in order round it

  /// A corner, or an arc or corner of the section on the axis that it turns about: what meets facets.
  bool is_point() const {
    return path == Path::corner || (path == Path::circular && section.centre.x() == 0.0);
  }
  /// Of a circular one: the arc seen along its axis, from the outside.
  Ridge<2> arc() const { return {{0, 0}, section.centre.x() + section.radius, {1, 0}, length}; }
  /// What may lie between the edges of a facet as long as this, m: points, and arcs that are shorter.
  bool meets_facets(double size) const {
    return is_point() || (path == Path::circular && arc().sharpness(size) > 0.0);
  }
  /// Place and direction of the path at `along`.
  struct Place {
    Vec3 centre{0, 0, 0}, u{0, 0, 0}, tangent{0, 0, 0}; ///< m; –, unit
  };
  Place at(double along) const;
  /// Of a circular one: where it faces x, as if it went all round.
  Place facing(const Vec3& x) const;
  /// The same as an angle, rad in [0, 2π); may lie beyond its end.
  double turn_towards(const Vec3& x) const;
  /// m, of x in the plane across the path, in the frame of the section, as if the path went on without end.
  Vec2 across(const Vec3& x) const;
  /// m, of a point from the line or circle of the path, as if it went on without end; not of a corner.
  double distance(const Vec3& x) const;
  /// m, of a point from the surface of the ridge, which ends.
  double clearance(const Vec3& x) const;
  /// How far the middle of an edge of length l (m) may be from the path for the edge to be met: crossings lie
  /// up to a tenth of l beside it, above the ridge or up to half of l deep.
  double reach(double l) const { return std::max(section.radius, 0.5 * l) + 0.601 * l; }
  /// Is the unit vector n, which is normal to the path there, among the outward normals?
  bool faces(const Vec3& n, const Place& place) const { return section.faces({n.dot(place.u), n.dot(v)}); }
  /// The same of a point, or of any place of a circular one.
  bool faces(const Vec3& n) const;
  /// Of a point: its place, m.
  Vec3 point() const { return path == Path::corner ? origin : Vec3(origin + section.centre.y() * v); }
  /// Around it with its radius.
  Box<3> bounds() const;
  /// Turned and shifted: x → rotation x + shift.
  Ridge moved(const Mat<3>& rotation, const Vec3& shift) const;
};

} // namespace cnem::contact
