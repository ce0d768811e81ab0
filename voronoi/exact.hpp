#pragma once
// Predicates of the plane whose sign is exact: rounding decides where it cannot be wrong (Shewchuk 1997),
// else CGAL, behind exact.cpp.
#include "core/vec.hpp"

#include <cmath>
#include <limits>

namespace cnem::voronoi {

/// The same two functions, whatever the places: where rounding does not decide.
int orientation_in_doubt(const Vec2& a, const Vec2& b, const Vec2& c);
bool in_circle_in_doubt(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Half of a unit in the last place of 1, and below which products may have lost digits to underflow.
constexpr double roundoff = 0.5 * std::numeric_limits<double>::epsilon(), underflow = 1e-280;

/// 1: a, b, c run counter-clockwise; −1: clockwise; 0: they lie on one line.
inline int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y()), right = (a.y() - c.y()) * (b.x() - c.x());
  const double area = left - right, bound = (3.0 + 16.0 * roundoff) * roundoff;
  if (std::abs(area) > bound * (std::abs(left) + std::abs(right)) + underflow) return area > 0.0 ? 1 : -1;
  return orientation_in_doubt(a, b, c);
}

/// Whether d is inside the circle through a, b, c, which run counter-clockwise. Of four cocircular points one
/// pair of opposite ones is outside, always the same: that of the triangulation's symbolic perturbation
/// (Devillers, Teillaud 2011).
inline bool in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double ax = a.x() - d.x(), ay = a.y() - d.y(), bx = b.x() - d.x(), by = b.y() - d.y();
  const double cx = c.x() - d.x(), cy = c.y() - d.y();
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  const double bc = bx * cy, cb = cx * by, ca = cx * ay, ac = ax * cy, ab = ax * by, ba = bx * ay;
  const double volume = aa * (bc - cb) + bb * (ca - ac) + cc * (ab - ba);
  const double size = aa * (std::abs(bc) + std::abs(cb)) + bb * (std::abs(ca) + std::abs(ac)) +
                      cc * (std::abs(ab) + std::abs(ba));
  const double bound = (10.0 + 96.0 * roundoff) * roundoff;
  if (std::abs(volume) > bound * size + underflow) return volume > 0.0;
  return in_circle_in_doubt(a, b, c, d);
}

} // namespace cnem::voronoi
