#include "app/tool_tips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

double squared_distance(const std::vector<Vec2>& tips, const Vec2& shift, const Vec2& x) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec2& tip : tips) nearest = std::min(nearest, (tip + shift - x).squaredNorm());
  return nearest;
}

double distance_from_ridges(const contact::RigidContact<3>& contact, const Vec3& x, double most) {
  for (const ToolIndex t : contact.tools().indices()) {
    const contact::ToolShape<3>& shape = *contact.tools()[t].shape;
    const Vec3 at = x - contact.results()[t].displacement;
    const Box<3> box = shape.bounds();
    if ((box.low - at).cwiseMax(at - box.high).cwiseMax(0.0).norm() >= most) continue;
    for (const contact::Ridge<3>& ridge : shape.ridges()) most = std::min(most, ridge.clearance(at));
  }
  return most;
}

} // namespace cnem::app
