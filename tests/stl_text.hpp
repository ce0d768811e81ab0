#pragma once
// Files of triangles for tests.
#include "core/vec.hpp"

#include <array>
#include <fmt/format.h>
#include <string>

namespace cnem::testing {

/// A box as an STL file in text, in its unit.
inline std::string stl_box(const Vec3& low, const Vec3& high) {
  constexpr std::array<std::array<int, 4>, 6> faces{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const auto corner = [&](int k) {
    return fmt::format("vertex {} {} {}\n", (k & 1 ? high : low).x(), (k & 2 ? high : low).y(),
                       (k & 4 ? high : low).z());
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

} // namespace cnem::testing
