#pragma once
// How often the boundary of bodies in the plane runs round a point: the number of bodies there.
#include "core/vec.hpp"

namespace cnem {

/// What an edge from a to b adds to the winding number of the point x, the sum over closed loops: 1 where it
/// rises to the right of x, −1 where it falls there.
inline int winding_of_edge(const Vec2& a, const Vec2& b, const Vec2& x) {
  const double side = cross(b - a, x - a);
  if (a.y() <= x.y() && b.y() > x.y() && side > 0.0) return 1;
  if (a.y() > x.y() && b.y() <= x.y() && side < 0.0) return -1;
  return 0;
}

} // namespace cnem
