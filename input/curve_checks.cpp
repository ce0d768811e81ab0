#include "input/curve_checks.hpp"
#include "core/geometry/place_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::input {
namespace {

/// Fraction of the sweep of an arc at the direction of x from its centre; beyond 1 when x is off the arc.
double arc_fraction(const CurvePiece& arc, const Vec2& x) {
  const Vec2 a = arc.from - arc.centre, b = x - arc.centre;
  double angle = std::atan2(cross(a, b), a.dot(b));
  if (arc.clockwise) angle = -angle;
  if (angle < 0.0) angle += 2.0 * std::numbers::pi;
  return angle / std::abs(arc.sweep());
}

double distance_to_piece(const CurvePiece& piece, const Vec2& x) {
  const double to_ends = std::min((x - piece.from).norm(), (x - piece.to).norm());
  if (piece.is_arc())
    return arc_fraction(piece, x) <= 1.0 ? std::abs((x - piece.centre).norm() - piece.radius) : to_ends;
  const Vec2 along = piece.to - piece.from;
  const double s = std::clamp((x - piece.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - piece.from - s * along).norm();
}

/// Crossings of the infinite lines and whole circles that carry two pieces.
std::vector<Vec2> carrier_crossings(const CurvePiece& a, const CurvePiece& b) {
  if (!a.is_arc() && !b.is_arc()) {
    const Vec2 u = a.to - a.from, v = b.to - b.from;
    const double det = cross(u, v);
    if (std::abs(det) <= 1e-14 * u.norm() * v.norm()) return {};
    return {a.from + cross(b.from - a.from, v) / det * u};
  }
  if (a.is_arc() && b.is_arc()) {
    const Vec2 d = b.centre - a.centre;
    const double distance = d.norm();
    if (distance <= 1e-14 * (a.radius + b.radius)) return {};
    const double along = 0.5 * (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance);
    const double height = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
    if (std::abs(along) > a.radius * (1.0 + 1e-12)) return {};
    const Vec2 middle = a.centre + along / distance * d, side = height / distance * left_normal(d);
    return {middle + side, middle - side};
  }
  const CurvePiece &line = a.is_arc() ? b : a, &arc = a.is_arc() ? a : b;
  const Vec2 u = (line.to - line.from).normalized();
  const Vec2 foot = line.from + (arc.centre - line.from).dot(u) * u;
  const double offset = (foot - arc.centre).norm();
  if (offset > arc.radius * (1.0 + 1e-12)) return {};
  const double half = std::sqrt(std::max(0.0, (arc.radius - offset) * (arc.radius + offset)));
  return {foot + half * u, foot - half * u};
}

/// Crossings near a tangent joint come with the square root of the rounding error.
double joint_tolerance(const CurvePiece& a, const CurvePiece& b, double size) {
  return 1e-6 * size + 1e-7 * std::max(a.radius, b.radius);
}

constexpr double touching = 1e-9; ///< relative distance at which curves count as meeting

} // namespace

std::string show(const Vec3& x) { return place_text(x) + " m"; }

std::string show(const Vec2& x) { return place_text(x) + " m"; }

std::array<Vec2, 2> bounds(const Curve& curve) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const CurvePiece& piece : curve.pieces)
    for (const double s : {0.0, 0.25, 0.5, 0.75}) {
      low = low.cwiseMin(piece.point(s));
      high = high.cwiseMax(piece.point(s));
    }
  return {low, high};
}

double extent(const Curve& curve) {
  if (curve.pieces.empty()) return 0.0;
  const auto [low, high] = bounds(curve);
  return (high - low).norm();
}

namespace {

/// Whether the boxes around two pieces are more than twice the tolerance apart: then no point is near both.
bool apart(const CurvePiece& a, const CurvePiece& b, double tolerance) {
  const auto low = [](const CurvePiece& p) {
    return p.is_arc() ? Vec2(p.centre.array() - p.radius) : Vec2(p.from.cwiseMin(p.to));
  };
  const auto high = [](const CurvePiece& p) {
    return p.is_arc() ? Vec2(p.centre.array() + p.radius) : Vec2(p.from.cwiseMax(p.to));
  };
  return ((low(a) - high(b)).array() > 4.0 * tolerance).any() ||
         ((low(b) - high(a)).array() > 4.0 * tolerance).any();
}

} // namespace

std::vector<Vec2> meeting_points(const CurvePiece& a, const CurvePiece& b, double tolerance) {
  if (apart(a, b, tolerance)) return {};
  std::vector<Vec2> points;
  for (const Vec2& x : carrier_crossings(a, b))
    if (distance_to_piece(a, x) <= tolerance && distance_to_piece(b, x) <= tolerance) points.push_back(x);
  for (const Vec2& end : {a.from, a.to})
    if (distance_to_piece(b, end) <= tolerance) points.push_back(end);
  for (const Vec2& end : {b.from, b.to})
    if (distance_to_piece(a, end) <= tolerance) points.push_back(end);
  return points;
}

std::optional<Vec2> self_crossing(const Curve& curve) {
  const double size = extent(curve);
  const std::size_t n = curve.pieces.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const CurvePiece &a = curve.pieces[i], &b = curve.pieces[j];
      const double joint = joint_tolerance(a, b, size);
      for (const Vec2& x : meeting_points(a, b, touching * size)) {
        const bool at_end_of_a = j == i + 1 && (x - a.to).norm() <= joint;
        const bool at_end_of_b = (j + 1) % n == i && (x - a.from).norm() <= joint;
        if (!at_end_of_a && !at_end_of_b) return x;
      }
    }
  return std::nullopt;
}

std::optional<Vec2> common_point(const Curve& a, const Curve& b) {
  const double size = std::max(extent(a), extent(b));
  for (const CurvePiece& p : a.pieces)
    for (const CurvePiece& q : b.pieces)
      if (const std::vector<Vec2> points = meeting_points(p, q, touching * size); !points.empty())
        return points.front();
  return std::nullopt;
}

double distance(const Curve& curve, const Vec2& x) {
  double least = std::numeric_limits<double>::max();
  for (const CurvePiece& piece : curve.pieces) least = std::min(least, distance_to_piece(piece, x));
  return least;
}

bool inside(const Curve& curve, const Vec2& x) {
  double winding = 0.0;
  for (const CurvePiece& piece : curve.pieces) {
    const Vec2 a = piece.from - x, b = piece.to - x;
    double angle = std::atan2(cross(a, b), a.dot(b));
    // Seen from inside its circle, an arc turns one way only; from outside it turns like its chord.
    if (piece.is_arc() && (x - piece.centre).norm() < piece.radius) {
      if (piece.clockwise && angle > 0.0) angle -= 2.0 * std::numbers::pi;
      if (!piece.clockwise && angle < 0.0) angle += 2.0 * std::numbers::pi;
    }
    winding += angle;
  }
  return std::abs(winding) > std::numbers::pi;
}

} // namespace cnem::input
