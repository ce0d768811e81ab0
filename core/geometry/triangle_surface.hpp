#pragma once
// Closed surfaces of triangles.
#include "core/geometry/stl.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem {

/// Triangles on shared points; their normals, right-handed, point out of the solid.
struct TriangleSurface {
  std::vector<Vec3> points;                           ///< m
  std::vector<std::array<std::int32_t, 3>> triangles; ///< of points

  std::array<Vec3, 3> corners(std::size_t triangle) const {
    const auto& t = triangles[triangle];
    return {points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
            points[static_cast<std::size_t>(t[2])]};
  }
  double volume() const; ///< m³, enclosed; negative where normals point inwards
};

/// Throws GeometryError, with the numbers and places of up to three triangles, unless every edge has exactly
/// two triangles that run along it in opposite senses, no triangle is without area, and the volume is
/// positive. O(n log n).
void check_closed(const TriangleSurface& surface);

/// The corners of all triangles as points, in the order in which they come first: those closer than a
/// millionth of the size of the soup are one, as what wrote them may have rounded them. Expects triangles.
TriangleSurface numbered_corners(const FacetSoup& soup);

/// The soup with corners that numbered_corners takes for one at the same place, for files of triangles.
FacetSoup welded(FacetSoup soup);

/// Corners with the same coordinates are one point; triangles with two of these are left out.
TriangleSurface joined(const FacetSoup& soup);

} // namespace cnem
