#pragma once
// An orthogonal cut as its geometry has it: which way the tool moves, its rake face and its edge.
#include "input/case.hpp"

namespace cnem::input {

/// A tool that cuts, at t = 0. Its frame has the origin at `tip` and the axes `along` and `away`, the second
/// to the left or to the right of the first.
struct CuttingTool {
  Vec2 along{1, 0};  ///< unit vector of the tool's motion through the workpiece
  Vec2 away{0, 1};   ///< unit vector normal to it, out of the surface that the tool leaves behind
  Vec2 tip{0, 0};    ///< m, where the rake face, prolonged, meets the level of the tool's lowest point
  double rake = 0.0; ///< rad, > 0: the face leans back
  double begin = 0.0, end = 0.0; ///< m, from the tip along the rake face: where its straight part lies
  double depth = 0.0;            ///< m, from the highest point of the workpiece down to the tip

  /// In the frame of the tool, which has moved by `moved`, m.
  Vec2 place(const Vec2& x, const Vec2& moved) const { return turned(x - tip - moved); }
  Vec2 turned(const Vec2& v) const { return {v.dot(along), v.dot(away)}; }
  // In that frame: unit vectors along the rake face, away from the edge, and out of the tool there.
  Vec2 face() const;
  Vec2 normal() const;
};

/// Throws InputError, with what was found and expected, where the tool does not move in the run, has no side
/// that faces the cut, or does not reach into the workpiece.
CuttingTool cutting_tool(const Case& input, std::size_t tool);

} // namespace cnem::input
