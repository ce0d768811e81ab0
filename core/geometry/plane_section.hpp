#pragma once
// Plane cuts through closed surfaces of triangles.
#include "core/geometry/triangle_surface.hpp"
#include "core/vec.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem {

/// A plane with two axes, seen from where right × up points.
struct CutPlane {
  Vec3 at{0, 0, 0};    ///< m, a place on it
  Vec3 right{1, 0, 0}; ///< unit vector
  Vec3 up{0, 1, 0};    ///< unit vector, normal to `right`

  Vec3 towards() const { return right.cross(up); }
  double height(const Vec3& x) const { return towards().dot(x - at); }
  Vec2 flat(const Vec3& x) const { return {right.dot(x - at), up.dot(x - at)}; }
};

/// A closed polygon in the plane, the solid on its left.
struct SectionLoop {
  std::vector<Vec2> point; ///< m
  std::vector<std::array<std::int32_t, 2>>
      edge;                           ///< [point] ends of the edge of the surface that it lies on …
  std::vector<double> share;          ///< [point] … and how far from the first to the second, –
  std::vector<std::int32_t> triangle; ///< [point] of the surface, to the next point

  double area() const; ///< m²; negative: of a cavity
};

/// All loops of a cut, in the order of their first triangles. What lies in the plane counts as above it, so
/// that each edge is cut or not. Triangles that do not close (an edge with another number of triangles than
/// two) give no loop where they are cut. O(triangles).
std::vector<SectionLoop> cut(const TriangleSurface& surface, const CutPlane& plane);

/// Whether a place in the plane is inside a polygon.
bool inside(std::span<const Vec2> polygon, const Vec2& x);

/// Triangles that fill a simple counter-clockwise polygon, on its corners: ears are cut off. O(n²).
std::vector<std::array<std::size_t, 3>> ear_triangles(const std::vector<Vec2>& polygon);

} // namespace cnem
