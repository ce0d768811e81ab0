#include "input/cutting_edge.hpp"

#include "input/cutting_tool.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::input {
namespace {

constexpr double same_side = 1e-9; // of unit normals

/// The longest side with the normal of the rake face.
std::size_t face_of(const Curve& outline, const CuttingTool& cut) {
  std::size_t face = 0;
  double longest = 0.0;
  for (std::size_t k = 0; k < outline.pieces.size(); ++k) {
    const CurvePiece& piece = outline.pieces[k];
    if (piece.is_arc() || piece.length() <= longest) continue;
    if ((cut.turned(right_normal(piece.tangent(0.0))) - cut.normal()).norm() > same_side) continue;
    face = k, longest = piece.length();
  }
  return face;
}

} // namespace

CuttingEdge cutting_edge(const Case& input, std::size_t tool) {
  const CuttingTool cut = cutting_tool(input, tool);
  const Curve& outline = input.tools[tool].outline;
  const std::size_t face = face_of(outline, cut), count = outline.pieces.size();
  const bool upwards = (outline.pieces[face].to - outline.pieces[face].from).dot(cut.away) > 0.0;
  CuttingEdge edge;
  for (std::size_t k = 1; k < count; ++k) { // from the low end of the rake face on; chamfers face the motion
    const CurvePiece& piece = outline.pieces[(upwards ? face + count - k : face + k) % count];
    edge.radius = std::max(edge.radius, piece.radius);
    if (piece.is_arc()) continue;
    const Vec2 normal = cut.turned(right_normal(piece.tangent(0.0)));
    if (normal.x() > same_side) continue;
    edge.clearance = std::atan2(-normal.x(), -normal.y());
    break;
  }
  return edge;
}

} // namespace cnem::input
