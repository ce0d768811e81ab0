#pragma once
// The workpiece before a cut: what a layer of dexels begins with.
#include "core/geometry/triangle_surface.hpp"
#include "core/vec.hpp"
#include "machining/dexels.hpp"
#include "machining/slices.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace cnem::machining {

/// What a run has left of its workpiece, for the next one.
struct LeftWorkpiece {
  std::vector<Slice> slices;
  std::vector<DexelLayer> layers; ///< [slice]
  double turned = 0.0;            ///< steps that the cutter has turned by since the first run
  int steps_of_turn = 1;

  double height() const { return slices.back().low + slices.back().thickness; } ///< m
  /// Throws IoError for what is none.
  void archive(Archive& archive);
};

struct Blank {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero(); ///< m, across the axis of the cutter
  double height = 0.0; ///< m, from 0; edges reach through all of it that is over their tip
  /// m, in axes of the cut; all of the box without triangles.
  TriangleSurface surface{};
  std::shared_ptr<const LeftWorkpiece> left{}; ///< in place of the box
};

/// Convex pieces, counter-clockwise, that a plane at a height cuts from a closed surface: between the heights
/// along y of the corners of the section, sides of the section bound trapezoids. m
std::vector<std::array<Vec2, 4>> section_pieces(const TriangleSurface& surface, double height);

} // namespace cnem::machining
