#pragma once
// Facets as STL files hold them, in text or binary: 80 bytes of anything, the number of triangles, and 50
// bytes for each; or "solid … facet … endsolid".
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cnem {

/// Every triangle brings its own corners.
struct FacetSoup {
  struct Triangle {
    std::array<Vec3, 3> corner; ///< m, anticlockwise as seen from outside
    std::int32_t solid = 0;
  };
  std::vector<Triangle> triangles;
  std::vector<std::string> solids; ///< their names; may be empty texts
};

/// Lengths times `scale` are in m. Normals are those of the order of the corners; those in the file are not
/// looked at. Throws InputError, with the line or triangle, for what is no STL, ends early, has no triangle,
/// or numbers that are not finite.
FacetSoup parse_stl(std::string_view bytes, double scale);

} // namespace cnem
