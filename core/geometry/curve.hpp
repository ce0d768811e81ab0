#pragma once
// Closed curves of segments and circular arcs: outlines of domains, holes and rigid tools.
#include "core/vec.hpp"

#include <string>
#include <vector>

namespace cnem {

/// A straight segment (radius = 0) or a circular arc from `from` to `to`. Lengths in m.
struct CurvePiece {
  Vec2 from{0, 0};
  Vec2 to{0, 0};
  Vec2 centre{0, 0};      ///< arcs only
  double radius = 0.0;    ///< 0 for a segment
  bool clockwise = false; ///< arcs only: sense of travel from `from` to `to`; from == to is a full circle
  std::string name;       ///< name of the boundary piece it makes; may be shared

  bool is_arc() const { return radius > 0.0; }
  /// Signed angle travelled by an arc, rad: in (0, 2π] counter-clockwise, [−2π, 0) clockwise. 0 for a
  /// segment.
  double sweep() const;
  double length() const;
  /// Point at the fraction s in [0, 1] of the length.
  Vec2 point(double s) const;
  /// Unit tangent at the fraction s, in the sense of travel.
  Vec2 tangent(double s) const;
};

/// Pieces joined end to end, the last to the first. Counter-clockwise curves enclose; tools and outer
/// outlines are counter-clockwise (material on the left), holes are clockwise as boundaries of the domain.
struct Curve {
  std::vector<CurvePiece> pieces;

  double length() const;
  /// Signed enclosed area, m²: positive when counter-clockwise.
  double area() const;
  /// The same curve travelled the other way.
  Curve reversed() const;
  /// The image behind the line through `at` with the unit normal `normal`, travelled so that it turns as this
  /// one.
  Curve mirrored(const Vec2& at, const Vec2& normal) const;
  /// Corners of a polygon that leaves it by less than 1/4600 of the radius, without the last, which is the
  /// first.
  std::vector<Vec2> polygon() const;
};

/// The image of a point behind the line through `at` with the unit normal `normal`.
inline Vec2 mirrored(const Vec2& x, const Vec2& at, const Vec2& normal) {
  return x - 2.0 * normal.dot(x - at) * normal;
}

} // namespace cnem
