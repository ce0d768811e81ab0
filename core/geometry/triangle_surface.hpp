#pragma once
// Closed surfaces of triangles, and STL files that hold them.
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
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

/// Reads STL, text or binary, with one solid or several; lengths times `scale` are in m. Corners with the
/// same coordinates are one point, triangles with two of these are left out. Normals are those of the order
/// of the corners; those in the file are not looked at. Throws InputError, with the line or triangle, for
/// what is no STL, ends early, or has numbers that are not finite.
TriangleSurface parse_stl(std::string_view bytes, double scale);

/// The same from a file; the message names it. Throws InputError where it cannot be read.
TriangleSurface read_stl(const std::string& path, double scale);

} // namespace cnem
