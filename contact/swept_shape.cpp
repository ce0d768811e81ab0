#include "contact/swept_shape.hpp"

#include "contact/passage.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::contact {
namespace {

constexpr double rounding = 1e-9; ///< of a size

Vec3 in_space(const Vec2& x, double z) { return {x.x(), x.y(), z}; }

CurvePiece straight(const Vec2& from, const Vec2& to) { return {from, to, {0, 0}, 0.0, false, ""}; }

/// A rectangle with a quarter of a circle at both corners on its right.
Curve strip(double depth, double low, double high, double radius_low, double radius_high) {
  Curve curve;
  curve.pieces.push_back(straight({-depth, low}, {-radius_low, low}));
  if (radius_low > 0.0)
    curve.pieces.push_back({{-radius_low, low},
                            {0.0, low + radius_low},
                            {-radius_low, low + radius_low},
                            radius_low,
                            false,
                            ""});
  if (high - radius_high > low + radius_low)
    curve.pieces.push_back(straight({0.0, low + radius_low}, {0.0, high - radius_high}));
  if (radius_high > 0.0)
    curve.pieces.push_back({{0.0, high - radius_high},
                            {-radius_high, high},
                            {-radius_high, high - radius_high},
                            radius_high,
                            false,
                            ""});
  curve.pieces.push_back(straight({-radius_high, high}, {-depth, high}));
  curve.pieces.push_back(straight({-depth, high}, {-depth, low}));
  return curve;
}

/// The section with its image behind the axis; as it is where it does not touch the axis.
Curve on_both_sides(const Curve& section) {
  double size = 0.0;
  for (const CurvePiece& piece : section.pieces) size = std::max({size, piece.from.norm(), piece.radius});
  const double tolerance = rounding * size;
  const auto on_axis = [&](const CurvePiece& piece) {
    return !piece.is_arc() && std::abs(piece.from.x()) <= tolerance && std::abs(piece.to.x()) <= tolerance;
  };
  for (const CurvePiece& piece : section.pieces)
    for (int k = 0; k < 16; ++k)
      if (const Vec2 x = piece.point(k / 16.0); x.x() < -tolerance)
        throw InputError(fmt::format("a section that turns about an axis reaches beyond it, to a distance of "
                                     "{:.6g} m at z = {:.6g} m, expected distances of 0 and more",
                                     x.x(), x.y()));
  const auto& pieces = section.pieces;
  const std::size_t n = pieces.size();
  std::vector<std::size_t> ends; // of runs of pieces on the axis
  for (std::size_t i = 0; i < n; ++i)
    if (on_axis(pieces[i]) && !on_axis(pieces[(i + 1) % n])) ends.push_back(i);
  if (ends.empty()) return section;
  if (ends.size() > 1)
    throw InputError("a section that turns about an axis touches it in several places, expected one");
  Curve whole;
  for (std::size_t k = 1; k <= n; ++k) {
    CurvePiece piece = pieces[(ends[0] + k) % n];
    if (on_axis(piece)) continue;
    for (Vec2* end : {&piece.from, &piece.to, &piece.centre})
      if (std::abs(end->x()) <= tolerance) end->x() = 0.0;
    whole.pieces.push_back(std::move(piece));
  }
  for (std::size_t k = whole.pieces.size(); k-- > 0;) {
    CurvePiece image = whole.pieces[k];
    std::swap(image.from, image.to);
    for (Vec2* x : {&image.from, &image.to, &image.centre}) x->x() = -x->x();
    whole.pieces.push_back(image);
  }
  return whole;
}

/// Points of a curve, some for each piece.
std::vector<Vec2> points_of(const Curve& curve) {
  std::vector<Vec2> points;
  for (const CurvePiece& piece : curve.pieces)
    for (const double at : {0.125, 0.375, 0.625, 0.875}) points.push_back(piece.point(at));
  return points;
}

} // namespace

SweptShape::SweptShape(std::optional<CurveShape> outline, CurveShape section)
    : outline_(std::move(outline)), section_(std::move(section)),
      ridges_(swept_ridges(outline_ ? &*outline_ : nullptr, section_)),
      least_thickness_(section_.least_thickness()) {
  const Box<2> across = section_.bounds();
  Box<2> plan{{-across.high.x(), -across.high.x()}, {across.high.x(), across.high.x()}};
  if (outline_) {
    plan = outline_->bounds();
    plan.low.array() -= across.high.x();
    plan.high.array() += across.high.x();
    if (across.low.x() < 0.0) least_thickness_ = std::min(least_thickness_, outline_->least_thickness());
  }
  bounds_ = {contact::in_space(plan.low, across.low.y()), contact::in_space(plan.high, across.high.y())};
}

SweptShape SweptShape::extruded(Curve outline, double low, double high, double radius_low,
                                double radius_high) {
  if (!(low < high))
    throw InputError(fmt::format(
        "an extruded outline from z = {:.6g} m to {:.6g} m has no volume, expected a higher end", low, high));
  if (!(radius_low >= 0.0 && radius_high >= 0.0 && radius_low + radius_high <= high - low))
    throw InputError(fmt::format("edges with radii of {:.6g} m and {:.6g} m do not fit on a length of {:.6g} "
                                 "m, expected a longer tool or smaller radii",
                                 radius_low, radius_high, high - low));
  CurveShape plan(std::move(outline));
  const Box<2> box = plan.bounds(); // no point inside is farther from the outline than half of its width
  const double depth = (box.high - box.low).norm() + radius_low + radius_high;
  return {std::move(plan), CurveShape(strip(depth, low, high, radius_low, radius_high))};
}

SweptShape SweptShape::revolved(const Curve& section) {
  return {std::nullopt, CurveShape(on_both_sides(section))};
}

SweptShape SweptShape::along(Curve outline, Curve section) {
  return {CurveShape(std::move(outline)), CurveShape(std::move(section))};
}

SweptShape::Footing SweptShape::footing(const Vec2& x) const {
  if (outline_) {
    const SurfacePoint<2> foot = outline_->closest(x);
    return {foot.distance, foot.normal, foot.feature};
  }
  const double r = x.norm();
  return {r, r > 0.0 ? Vec2(x / r) : Vec2(1, 0), 0};
}

SurfacePoint<3> SweptShape::in_space(const SurfacePoint<2>& on_section, const Footing& foot,
                                     const Vec3& x) const {
  SurfacePoint<3> at;
  at.distance = on_section.distance;
  at.normal = contact::in_space(on_section.normal.x() * foot.outwards, on_section.normal.y());
  at.point = x - at.distance * at.normal;
  at.feature = foot.feature * as<std::int32_t>(section_.curve().pieces.size()) + on_section.feature;
  return at;
}

SurfacePoint<3> SweptShape::closest(const Vec3& x) const {
  const Footing foot = footing(x.head<2>());
  return in_space(section_.closest({foot.distance, x.z()}), foot, x);
}

/// Whether a place of the section is on a face that stands on the outline itself, with the solid inside of
/// it.
bool SweptShape::on_own_outline(const SurfacePoint<2>& at) const {
  const CurvePiece& piece = section_.curve().pieces[index_of(at.feature)];
  return outline_ && !piece.is_arc() && piece.from.x() == 0.0 && piece.to.x() == 0.0 && at.normal.x() > 0.0;
}

void SweptShape::entries(std::span<const Vec3> from, std::span<const Vec3> to,
                         std::vector<Entry<3>>& found) const {
  std::vector<Entry<2>> on_section, on_outline;
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (!bounds_.contains(to[k])) continue;
    const Footing stop = footing(to[k].head<2>());
    const Vec2 b(stop.distance, to[k].z());
    if (!section_.bounds().contains(b)) continue;
    const Vec2 a(footing(from[k].head<2>()).distance, from[k].z());
    on_section.clear();
    section_.entries({&a, 1}, {&b, 1}, on_section);
    if (on_section.empty()) continue;
    const Entry<2>& entry = on_section.front();
    const auto index = static_cast<std::int32_t>(k);
    found.push_back({index, in_space(entry.at, stop, to[k]), entry.start});
    if (!on_own_outline(entry.at)) continue;
    // of the faces of an outline the one that the path came through, which need not be the closest
    const Vec2 before = from[k].head<2>(), after = to[k].head<2>();
    on_outline.clear();
    outline_->entries({&before, 1}, {&after, 1}, on_outline);
    if (on_outline.empty()) continue;
    const SurfacePoint<2>& face = on_outline.front().at;
    found.back().at = in_space({face.distance, entry.at.normal, face.point, entry.at.feature},
                               {face.distance, face.normal, face.feature}, to[k]);
    found.back().start = on_outline.front().start;
  }
}

double SweptShape::thickness_along(const Vec3& direction) const {
  std::vector<Vec3> points;
  for (const Vec2& p : points_of(section_.curve())) {
    if (!outline_) {
      for (int k = 0; k < 8; ++k) {
        const double turn = (k + 0.5) * std::numbers::pi / 4.0;
        points.push_back(contact::in_space(std::abs(p.x()) * Vec2(std::cos(turn), std::sin(turn)), p.y()));
      }
      continue;
    }
    for (const Vec2& q : points_of(outline_->curve())) {
      const Vec2 place = q + p.x() * outline_->closest(q).normal;
      if (const Vec3 x = contact::in_space(place, p.y());
          std::abs(closest(x).distance) <= rounding * (bounds_.high - bounds_.low).norm())
        points.push_back(x);
    }
  }
  return thickness_by_tracing(*this, points, direction);
}

double SweptShape::passed(const Vec3& from, const Vec3& to) const {
  return passed_by_tracing(*this, from, to);
}

} // namespace cnem::contact
