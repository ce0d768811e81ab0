#include "app/tool_tips.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::app {

std::vector<Vec2> tool_tips(const Curve& outline, double spacing) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < outline.pieces.size(); ++k) {
    const CurvePiece &piece = outline.pieces[k], &next = outline.pieces[(k + 1) % outline.pieces.size()];
    constexpr double smooth = 0.999;
    if (piece.tangent(1.0).dot(next.tangent(0.0)) < smooth) points.push_back(piece.to);
    if (!piece.is_arc()) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(piece.length() / spacing)));
    for (int c = 0; c <= count; ++c) points.push_back(piece.point(static_cast<double>(c) / count));
  }
  return points;
}

} // namespace cnem::app
