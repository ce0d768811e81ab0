#include "contact/curve_shape.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::contact {
namespace {

double angle_between(const Vec2& a, const Vec2& b) { return std::atan2(cross(a, b), a.dot(b)); }

Curve checked(Curve curve) {
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
  return curve;
}

} // namespace

CurveShape::Face::Face(const CurvePiece& piece)
    : from(piece.from), to(piece.to), along(piece.tangent(0.0)), normal(right_normal(along)),
      length(piece.length()), centre(piece.centre), radius(piece.radius), side(piece.clockwise ? -1.0 : 1.0),
      sweep(std::abs(piece.sweep())) {}

/// Is a direction from the centre of an arc on the arc?
bool CurveShape::Face::spans(const Vec2& direction) const {
  const Vec2 &first = side > 0.0 ? from : to, &last = side > 0.0 ? to : from;
  const double after = cross(first - centre, direction), before = cross(direction, last - centre);
  if (sweep <= std::numbers::pi) return after >= 0.0 && before >= 0.0;
  return after >= 0.0 || before >= 0.0 || sweep >= full_turn;
}

/// Closest point; `end` is −1 at `from`, +1 at `to` and 0 between them.
Vec2 CurveShape::Face::foot(const Vec2& x, int& end) const {
  end = 0;
  if (radius > 0.0) {
    const Vec2 d = x - centre;
    const double r = d.norm();
    if (r > 0.0 && spans(d)) return centre + radius / r * d;
    end = (x - from).squaredNorm() <= (x - to).squaredNorm() ? -1 : 1;
  } else {
    const double s = along.dot(x - from);
    if (s > 0.0 && s < length) return from + s * along;
    end = s <= 0.0 ? -1 : 1;
  }
  return end < 0 ? from : to;
}

/// Outward normal of the face, continued beyond its ends, where it faces x.
Vec2 CurveShape::Face::normal_towards(const Vec2& x) const {
  if (radius == 0.0) return normal;
  const Vec2 d = x - centre;
  const double r = d.norm();
  return r > 0.0 ? Vec2(side / r * d) : normal;
}

/// Signed distance from the face continued to its whole line or circle, positive out of the solid.
double CurveShape::Face::gap(const Vec2& x) const {
  return radius == 0.0 ? normal.dot(x - from) : side * ((x - centre).norm() - radius);
}

/// Fraction of the path a → b where it passes from outside to inside of the continued face, given the gaps
/// at both (start ≥ 0 > stop).
double CurveShape::Face::crossing(const Vec2& a, const Vec2& b, double start, double stop) const {
  if (radius == 0.0) return start / (start - stop);
  const Vec2 d = b - a;
  const double along_d = (a - centre).dot(d), length2 = d.squaredNorm();
  const double power = side * start * ((a - centre).norm() + radius);
  const double root = std::sqrt(std::max(0.0, along_d * along_d - length2 * power));
  double s = 0.0;
  if (side > 0.0)
    s = power / (root - along_d);
  else
    s = along_d < 0.0 ? (root - along_d) / length2 : -power / (along_d + root);
  return std::clamp(s, 0.0, 1.0);
}

CurveShape::CurveShape(Curve curve) : curve_(checked(std::move(curve))), thickness_(curve_) {
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
    faces_.emplace_back(piece);
    include(piece.from);
    for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)})
      if (piece.is_arc() && faces_.back().spans(axis)) include(piece.centre + piece.radius * axis);
  }
  tolerance_ = 1e-12 * (bounds_.high - bounds_.low).norm();
}

SurfacePoint<2> CurveShape::closest(const Vec2& x) const {
  SurfacePoint<2> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    int end = 0;
    const Vec2 foot = faces_[i].foot(x, end);
    const double distance2 = (x - foot).squaredNorm();
    if (distance2 >= least) continue;
    least = distance2;
    best.point = foot;
    best.feature = static_cast<std::int32_t>(i);
  }
  const auto i = index_of(best.feature);
  const Face& face = faces_[i];
  const Vec2 away = x - best.point;
  const double length = std::sqrt(least), rounding2 = tolerance_ * tolerance_;
  const bool at_from = (best.point - face.from).squaredNorm() <= rounding2,
             at_to = (best.point - face.to).squaredNorm() <= rounding2;
  if (!at_from && !at_to) {
    best.normal = face.normal_towards(x);
    best.distance = away.dot(best.normal);
    return best;
  }
  // At an end shared by two pieces the sum of their normals tells inside from outside.
  const Vec2& corner = corner_normal_[at_to ? (i + 1) % faces_.size() : i];
  const double side = away.dot(corner) < 0.0 ? -1.0 : 1.0;
  best.normal = length > tolerance_ ? Vec2(side / length * away) : corner;
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
    std::size_t through = faces_.size();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const Face& face = faces_[i];
      const double stop = face.gap(b);
      if (stop >= 0.0 || -stop > reach) continue;
      const double start = face.gap(a);
      if (start < -tolerance_) continue;
      const double s = face.crossing(a, b, std::max(start, 0.0), stop);
      const Vec2 gate = a + s * (b - a);
      int end = 0;
      if ((face.foot(gate, end) - gate).norm() > 10.0 * tolerance_) continue;
      if (s < latest || (s == latest && stop <= shallowest)) continue;
      latest = s;
      shallowest = stop;
      through = i;
    }
    Entry<2> entry{static_cast<std::int32_t>(k), nearest, 0.0};
    if (through < faces_.size()) {
      const Face& face = faces_[through];
      entry.at.distance = face.gap(b);
      entry.at.normal = face.normal_towards(b);
      entry.at.point = b - entry.at.distance * entry.at.normal;
      entry.at.feature = static_cast<std::int32_t>(through);
      entry.start = face.gap(a);
    } else {
      entry.start = closest(a).distance;
    }
    found.push_back(entry);
  }
}

} // namespace cnem::contact
