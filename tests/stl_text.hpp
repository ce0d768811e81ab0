#pragma once
// Files of triangles for tests.
#include "core/vec.hpp"

#include <array>
#include <fmt/format.h>
#include <string>

namespace cnem::testing {

/// A body of six faces as an STL file in text, in its unit: corner k lies beyond along x, y, z where bits 1,
/// 2, 4 of k are set.
inline std::string stl_hexahedron(const std::array<Vec3, 8>& corners) {
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto corner = [&](int k) {
    const Vec3& at = corners[static_cast<std::size_t>(k)];
    return fmt::format("vertex {} {} {}\n", at.x(), at.y(), at.z());
  };
  std::string text = "solid box\n";
  for (const auto& [a, b, c, d] : faces)
    for (const std::array<int, 3>& triangle : {std::array{a, b, c}, std::array{a, c, d}}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int k : triangle) text += corner(k);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid box\n";
}

inline std::string stl_box(const Vec3& low, const Vec3& high) {
  std::array<Vec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners[k] = {(k & 1U ? high : low).x(), (k & 2U ? high : low).y(), (k & 4U ? high : low).z()};
  return stl_hexahedron(corners);
}

} // namespace cnem::testing
