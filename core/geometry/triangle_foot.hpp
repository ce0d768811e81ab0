#pragma once
// The point of a triangle that is nearest to a place.
#include "core/vec.hpp"

#include <array>

namespace cnem {

struct TriangleFoot {
  Vec3 point{0, 0, 0};            ///< m
  std::array<double, 3> weight{}; ///< of the corners; exactly 0 where it is on an edge or a corner
};

/// Ericson, Real-Time Collision Detection, 5.1.5.
TriangleFoot foot_on_triangle(const std::array<Vec3, 3>& corner, const Vec3& x);

} // namespace cnem
