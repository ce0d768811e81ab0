#pragma once
// The workpiece before a cut: what a layer of dexels begins with.
#include "core/geometry/triangle_surface.hpp"
#include "core/vec.hpp"

#include <array>
#include <vector>

namespace cnem::machining {

struct Blank {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero(); ///< m, across the axis of the cutter
  double height = 0.0; ///< m, from 0; edges reach through all of it that is over their tip
  /// m, in axes of the cut; all of the box without triangles.
  TriangleSurface surface{};
};

/// Convex pieces, counter-clockwise, that a plane at a height cuts from a closed surface: between the heights
/// along y of the corners of the section, sides of the section bound trapezoids. m
std::vector<std::array<Vec2, 4>> section_pieces(const TriangleSurface& surface, double height);

} // namespace cnem::machining
