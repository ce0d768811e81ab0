#include "core/geometry/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem {

double CurvePiece::sweep() const {
  if (!is_arc()) return 0.0;
  const Vec2 a = from - centre, b = to - centre;
  double angle = std::atan2(cross(a, b), a.dot(b));
  constexpr double full = 2.0 * std::numbers::pi;
  if ((to - from).norm() <= 1e-12 * radius) return clockwise ? -full : full;
  if (!clockwise && angle <= 0.0) angle += full;
  if (clockwise && angle >= 0.0) angle -= full;
  return angle;
}

double CurvePiece::length() const { return is_arc() ? radius * std::abs(sweep()) : (to - from).norm(); }

Vec2 CurvePiece::point(double s) const {
  if (s <= 0.0) return from;
  if (s >= 1.0) return to;
  if (!is_arc()) return (1.0 - s) * from + s * to;
  const double angle = s * sweep(), c = std::cos(angle), n = std::sin(angle);
  const Vec2 a = from - centre;
  return centre + Vec2(c * a.x() - n * a.y(), n * a.x() + c * a.y());
}

Vec2 CurvePiece::tangent(double s) const {
  if (!is_arc()) return (to - from).normalized();
  const Vec2 outward = (point(s) - centre).normalized();
  return clockwise ? right_normal(outward) : left_normal(outward);
}

double Curve::length() const {
  double sum = 0.0;
  for (const CurvePiece& piece : pieces) sum += piece.length();
  return sum;
}

double Curve::area() const {
  double sum = 0.0;
  for (const CurvePiece& piece : pieces) {
    sum += 0.5 * cross(piece.from - pieces.front().from, piece.to - pieces.front().from);
    const double angle = piece.sweep();
    if (piece.is_arc())
      sum += 0.5 * piece.radius * piece.radius * (angle - std::sin(angle)); // circular segment
  }
  return sum;
}

Curve Curve::reversed() const {
  Curve other;
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    other.pieces.push_back(*piece);
    std::swap(other.pieces.back().from, other.pieces.back().to);
    other.pieces.back().clockwise = !piece->clockwise;
  }
  return other;
}

Curve Curve::mirrored(const Vec2& at, const Vec2& normal) const {
  Curve other = reversed();
  for (CurvePiece& piece : other.pieces) {
    for (Vec2* x : {&piece.from, &piece.to, &piece.centre}) *x = cnem::mirrored(*x, at, normal);
    piece.clockwise = !piece.clockwise;
  }
  return other;
}

std::vector<Vec2> Curve::polygon() const {
  std::vector<Vec2> corners;
  for (const CurvePiece& piece : pieces) {
    const int parts =
        piece.is_arc() ? std::max(8, static_cast<int>(std::ceil(std::abs(piece.sweep()) * 24))) : 1;
    for (int k = 0; k < parts; ++k) corners.push_back(piece.point(static_cast<double>(k) / parts));
  }
  return corners;
}

} // namespace cnem
