#include "contact/curve_shape.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::contact {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vec2 normal_at(const CurvePiece& piece, double s) { return right_normal(piece.tangent(s)); }

double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

/// Is the direction `d` from the centre of an arc on the arc?
bool on_arc(const CurvePiece& arc, const Vec2& d) {
  const double sweep = arc.sweep();
  double angle = angle_between(arc.from - arc.centre, d);
  if (sweep < 0.0) angle = -angle;
  if (angle < 0.0) angle += full_turn;
  return angle <= std::abs(sweep);
}

struct Foot {
  Vec2 point{0, 0};
  int end = 0; ///< −1: at `from`, +1: at `to`, 0: between them
};

Foot foot_on(const CurvePiece& piece, const Vec2& x) {
  if (piece.is_arc()) {
    const Vec2 d = x - piece.centre;
    const double r = d.norm();
    if (r > 0.0 && on_arc(piece, d)) return {piece.centre + piece.radius / r * d, 0};
    if (r == 0.0) return {piece.point(0.5), 0};
    return (x - piece.from).squaredNorm() <= (x - piece.to).squaredNorm() ? Foot{piece.from, -1}
                                                                          : Foot{piece.to, 1};
  }
  const Vec2 t = piece.to - piece.from;
  const double s = t.dot(x - piece.from) / t.squaredNorm();
  if (s <= 0.0) return {piece.from, -1};
  if (s >= 1.0) return {piece.to, 1};
  return {piece.from + s * t, 0};
}

/// Outward normal of a piece, continued beyond its ends, where it faces x.
Vec2 normal_towards(const CurvePiece& piece, const Vec2& x) {
  if (!piece.is_arc()) return normal_at(piece, 0.0);
  const Vec2 d = x - piece.centre;
  if (d.squaredNorm() == 0.0) return normal_at(piece, 0.5);
  return piece.clockwise ? Vec2(-d.normalized()) : Vec2(d.normalized());
}

/// Signed distance from a piece continued to its whole line or circle, positive out of the solid.
double gap_to(const CurvePiece& piece, const Vec2& x) {
  if (!piece.is_arc()) return normal_at(piece, 0.0).dot(x - piece.from);
  const double gap = (x - piece.centre).norm() - piece.radius;
  return piece.clockwise ? -gap : gap;
}

/// Fraction of the path a → b where it passes from outside to inside of the continued piece, given the gaps
/// there (start ≥ 0 > end).
double crossing(const CurvePiece& piece, const Vec2& a, const Vec2& b, double start, double end) {
  if (!piece.is_arc()) return start / (start - end);
  const Vec2 d = b - a;
  const double along = (a - piece.centre).dot(d), length2 = d.squaredNorm();
  const double power = (piece.clockwise ? -start : start) * ((a - piece.centre).norm() + piece.radius);
  const double root = std::sqrt(std::max(0.0, along * along - length2 * power));
  const double s = piece.clockwise ? (along < 0.0 ? (root - along) / length2 : -power / (along + root))
                                   : power / (root - along);
  return std::clamp(s, 0.0, 1.0);
}

void check(const Curve& curve) {
  if (curve.pieces.empty()) throw InputError("a tool needs a closed curve, got one without pieces");
  double size = 0.0;
  for (const CurvePiece& piece : curve.pieces) size += piece.length();
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const CurvePiece& piece = curve.pieces[i];
    const CurvePiece& next = curve.pieces[(i + 1) % curve.pieces.size()];
    if (piece.length() <= 1e-12 * size)
      throw InputError(fmt::format("piece {} of a tool's curve has no length at ({:.6g}, {:.6g}) m", i,
                                   piece.from.x(), piece.from.y()));
    if ((piece.to - next.from).norm() > 1e-9 * size)
      throw InputError(fmt::format("a tool's curve is not closed: piece {} ends at ({:.9g}, {:.9g}) m and "
                                   "the next begins at ({:.9g}, {:.9g}) m",
                                   i, piece.to.x(), piece.to.y(), next.from.x(), next.from.y()));
    for (const Vec2& end : {piece.from, piece.to})
      if (piece.is_arc() && std::abs((end - piece.centre).norm() - piece.radius) > 1e-6 * piece.radius)
        throw InputError(fmt::format("arc {} of a tool's curve: its end ({:.9g}, {:.9g}) m is {:.6g} m from "
                                     "its centre, expected the radius {:.6g} m",
                                     i, end.x(), end.y(), (end - piece.centre).norm(), piece.radius));
  }
  if (curve.area() <= 0.0)
    throw InputError(fmt::format("a tool's curve must run counter-clockwise round the solid, got one that "
                                 "encloses {:.6g} m²",
                                 curve.area()));
}

} // namespace

bool Ridge<2>::faces(const Vec2& n) const {
  constexpr double tolerance = 1e-6;
  double turn = angle_between(first, n);
  if (turn < -tolerance) turn += full_turn;
  return turn <= angle + tolerance;
}

double Ridge<2>::sagitta(double l) const {
  const double most = radius * (1.0 - std::cos(0.5 * std::min(angle, std::numbers::pi)));
  if (l >= 2.0 * radius) return most;
  return std::min(most, 0.25 * l * l / (radius + std::sqrt(radius * radius - 0.25 * l * l)));
}

CurveShape::CurveShape(Curve curve) : curve_(std::move(curve)) {
  check(curve_);
  bounds_ = {curve_.pieces[0].from, curve_.pieces[0].from};
  const auto include = [&](const Vec2& x) {
    bounds_.low = bounds_.low.cwiseMin(x);
    bounds_.high = bounds_.high.cwiseMax(x);
  };
  const std::size_t n = curve_.pieces.size();
  for (std::size_t i = 0; i < n; ++i) {
    const CurvePiece &before = curve_.pieces[(i + n - 1) % n], &piece = curve_.pieces[i];
    const Vec2 arriving = before.tangent(1.0), leaving = piece.tangent(0.0);
    const double turn = angle_between(arriving, leaving);
    if (std::abs(turn) > std::numbers::pi - 1e-6)
      throw InputError(
          fmt::format("a tool's curve turns back on itself at ({:.6g}, {:.6g}) m: a corner needs "
                      "an angle above zero",
                      piece.from.x(), piece.from.y()));
    corner_normal_.push_back((right_normal(arriving) + right_normal(leaving)).normalized());
    if (turn > 1e-6) ridges_.push_back({piece.from, 0.0, right_normal(arriving), turn});
    if (piece.is_arc() && !piece.clockwise)
      ridges_.push_back({piece.centre, piece.radius, right_normal(leaving), piece.sweep()});
    include(piece.from);
    for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)})
      if (piece.is_arc() && on_arc(piece, axis)) include(piece.centre + piece.radius * axis);
  }
  tolerance_ = 1e-12 * (bounds_.high - bounds_.low).norm();
}

SurfacePoint<2> CurveShape::closest(const Vec2& x) const {
  SurfacePoint<2> best;
  double least = std::numeric_limits<double>::infinity();
  int end = 0;
  for (std::size_t i = 0; i < curve_.pieces.size(); ++i) {
    const Foot foot = foot_on(curve_.pieces[i], x);
    const double distance2 = (x - foot.point).squaredNorm();
    if (distance2 >= least) continue;
    least = distance2;
    best.point = foot.point;
    best.feature = static_cast<std::int32_t>(i);
    end = foot.end;
  }
  const auto piece = static_cast<std::size_t>(best.feature);
  if ((best.point - curve_.pieces[piece].from).squaredNorm() <= tolerance_ * tolerance_) end = -1;
  if ((best.point - curve_.pieces[piece].to).squaredNorm() <= tolerance_ * tolerance_) end = 1;
  const Vec2 away = x - best.point;
  const double length = away.norm();
  if (end == 0 && length > 0.0) {
    best.normal = normal_towards(curve_.pieces[piece], x);
    best.distance = away.dot(best.normal);
    return best;
  }
  // At an end shared by two pieces the sum of their normals tells inside from outside.
  const Vec2& corner = corner_normal_[end > 0 ? (piece + 1) % curve_.pieces.size() : piece];
  const Vec2 mean = end == 0 ? normal_towards(curve_.pieces[piece], x) : corner;
  const double side = away.dot(mean) < 0.0 ? -1.0 : 1.0;
  best.normal = length > tolerance_ ? Vec2(side / length * away) : mean;
  best.distance = side * length;
  return best;
}

void CurveShape::entries(std::span<const Vec2> from, std::span<const Vec2> to,
                         std::vector<Entry<2>>& found) const {
  for (std::size_t k = 0; k < to.size(); ++k) {
    const Vec2 &a = from[k], &b = to[k];
    if (!bounds_.contains(b)) continue;
    const SurfacePoint<2> nearest = closest(b);
    if (nearest.distance >= -1e-3 * tolerance_) continue; // rounding, not contact
    const double reach = (b - a).norm() + tolerance_;
    double latest = -1.0, shallowest = 0.0;
    std::size_t through = curve_.pieces.size();
    for (std::size_t i = 0; i < curve_.pieces.size(); ++i) {
      const CurvePiece& piece = curve_.pieces[i];
      const double start = gap_to(piece, a), end = gap_to(piece, b);
      if (end >= 0.0 || start < -tolerance_ || -end > reach) continue;
      const double s = crossing(piece, a, b, std::max(start, 0.0), end);
      const Vec2 gate = a + s * (b - a);
      if ((foot_on(piece, gate).point - gate).norm() > 10.0 * tolerance_) continue;
      if (s < latest || (s == latest && end <= shallowest)) continue;
      latest = s;
      shallowest = end;
      through = i;
    }
    Entry<2> entry{static_cast<std::int32_t>(k), nearest, 0.0};
    if (through < curve_.pieces.size()) {
      const CurvePiece& piece = curve_.pieces[through];
      entry.at.distance = gap_to(piece, b);
      entry.at.normal = normal_towards(piece, b);
      entry.at.point = b - entry.at.distance * entry.at.normal;
      entry.at.feature = static_cast<std::int32_t>(through);
      entry.start = gap_to(piece, a);
    } else {
      entry.start = closest(a).distance;
    }
    found.push_back(entry);
  }
}

} // namespace cnem::contact
