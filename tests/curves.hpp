#pragma once
// Outlines of straight sides for tests and benchmarks.
#include "core/geometry/curve.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace cnem::testing {

/// Closed polygon through the corners, m; all sides have the same name.
inline Curve polygon(const std::vector<Vec2>& corners, const std::string& name = "") {
  Curve curve;
  for (std::size_t k = 0; k < corners.size(); ++k)
    curve.pieces.push_back({corners[k], corners[(k + 1) % corners.size()], {0, 0}, 0.0, false, name});
  return curve;
}

/// Rectangle between two opposite corners, m: sides bottom, right, top, left.
inline Curve box(const Vec2& low, const Vec2& high, const std::string& name = "") {
  return polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, name);
}

} // namespace cnem::testing
