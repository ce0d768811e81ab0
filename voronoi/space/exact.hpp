#pragma once
// The predicate of space whose sign is exact: rounding decides where it cannot be wrong (Shewchuk 1997), else
// CGAL, behind exact.cpp.
#include "core/vec.hpp"
#include "voronoi/exact.hpp"

#include <cmath>

namespace cnem::voronoi {

/// The same, whatever the places: where rounding does not decide.
int orientation_in_doubt(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// 1: a, b, c, d are the corners of a right-handed tetrahedron (as voronoi::Simplex<3>); −1: of a left-handed
/// one; 0: they lie on one plane.
inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double bx = b.x() - a.x(), by = b.y() - a.y(), bz = b.z() - a.z();
  const double cx = c.x() - a.x(), cy = c.y() - a.y(), cz = c.z() - a.z();
  const double dx = d.x() - a.x(), dy = d.y() - a.y(), dz = d.z() - a.z();
  const double yz = by * cz, zy = bz * cy, zx = bz * cx, xz = bx * cz, xy = bx * cy, yx = by * cx;
  const double volume = (yz - zy) * dx + (zx - xz) * dy + (xy - yx) * dz;
  const double size = (std::abs(yz) + std::abs(zy)) * std::abs(dx) +
                      (std::abs(zx) + std::abs(xz)) * std::abs(dy) +
                      (std::abs(xy) + std::abs(yx)) * std::abs(dz);
  const double bound = (7.0 + 56.0 * roundoff) * roundoff;
  if (std::abs(volume) > bound * size + underflow) return volume > 0.0 ? 1 : -1;
  return orientation_in_doubt(a, b, c, d);
}

/// Of four nodes on one plane, a, b, c not on one line: whether d is inside the circle through a, b, c. Of
/// cocircular ones one pair of opposite ones is outside, always the same: that of the Delaunay triangulation.
bool in_coplanar_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

} // namespace cnem::voronoi
