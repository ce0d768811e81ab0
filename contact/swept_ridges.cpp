// Ridges of solids that are swept by a section: those of the section along the outline, those of the outline
// along the section, and the corners where both meet.
#include "contact/swept_shape.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cnem::contact {
namespace {

constexpr double least_turn = 1e-6; ///< rad

Vec3 in_space(const Vec2& x, double z) { return {x.x(), x.y(), z}; }

/// A corner of an outline between two pieces, or an arc of it.
struct Bend {
  Vec2 centre{0, 0};
  double radius = 0.0;            ///< m, 0 for a corner
  Vec2 before{0, 0}, after{0, 0}; ///< –, outward normals on both sides
  double turn = 0.0;              ///< rad, positive where the outline is convex
};

Vec2 last_normal(const Ridge<2>& ridge) { return Eigen::Rotation2Dd(ridge.angle) * ridge.first; }

/// What is left of an axis.
Ridge<2> mirrored(const Ridge<2>& ridge) {
  const Vec2 last = last_normal(ridge);
  return {{-ridge.centre.x(), ridge.centre.y()}, ridge.radius, {-last.x(), last.y()}, ridge.angle};
}

class Sweep {
public:
  Sweep(const CurveShape& outline, const CurveShape& section) : outline_(outline.curve()), section_(section) {
    const Box<2> plan = outline.bounds(), across = section.bounds();
    tolerance_ = 1e-9 * ((plan.high - plan.low).norm() + (across.high - across.low).norm());
    deepest_ = 0.5 * (plan.high - plan.low).minCoeff();
    const auto& pieces = outline_.pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const CurvePiece &last = pieces[(i + pieces.size() - 1) % pieces.size()], &piece = pieces[i];
      const Vec2 before = right_normal(last.tangent(1.0)), after = right_normal(piece.tangent(0.0));
      corner_.push_back(
          {piece.from, 0.0, before, after, std::atan2(cross(before, after), before.dot(after))});
      if (piece.is_arc())
        arc_.push_back({piece.centre, piece.radius, after, right_normal(piece.tangent(1.0)), piece.sweep()});
    }
  }

  std::vector<Ridge<3>> ridges() {
    for (const Ridge<2>& ridge : section_.ridges()) {
      if (ridge.centre.x() < -deepest_ - tolerance_) continue; // behind the middle of the outline
      along_sides(ridge);
      for (const Bend& corner : corner_) round_corner(ridge, corner);
      for (const Bend& arc : arc_) along_arc(ridge, arc);
    }
    for (const CurvePiece& piece : section_.curve().pieces)
      if (!piece.is_arc()) across_piece(piece);
    return std::move(found_);
  }

private:
  void along_sides(const Ridge<2>& ridge) {
    const auto& pieces = outline_.pieces;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].is_arc()) continue;
      // an offset line is cut short where it turns towards its own side
      const auto cut = [&](const Bend& corner) {
        return std::abs(corner.turn) < least_turn
                   ? 0.0
                   : std::max(0.0, -ridge.centre.x() * std::tan(0.5 * corner.turn));
      };
      const double first = cut(corner_[i]), last = cut(corner_[(i + 1) % pieces.size()]);
      const Vec2 tangent = pieces[i].tangent(0.0);
      const double length = pieces[i].length() - first - last;
      if (length <= tolerance_) continue;
      Ridge<3> along{.path = Ridge<3>::Path::straight, .section = ridge};
      along.origin = in_space(pieces[i].from + first * tangent, 0.0);
      along.u = in_space(right_normal(tangent), 0.0);
      along.length = length;
      found_.push_back(std::move(along));
    }
  }

  /// At a distance from a corner on its outer side the outline is an arc, on its inner side a corner.
  void round_corner(const Ridge<2>& ridge, const Bend& corner) {
    if (std::abs(corner.turn) < least_turn) return;
    const double d = ridge.centre.x(), side = corner.turn > 0.0 ? 1.0 : -1.0;
    if (side * d > tolerance_) {
      if (side > 0.0) {
        Bend arc = corner;
        along_arc(ridge, arc);
      }
      return; // in a notch nothing of the tool sticks out
    }
    const Vec2 last = last_normal(ridge);
    const bool outwards = side * ridge.first.x() > -least_turn && side * last.x() > -least_turn;
    if (!outwards) return;
    if (ridge.radius > 0.0)
      throw InputError(fmt::format(
          "an edge with a radius of {:.6g} m goes round a sharp corner of the outline at ({:.6g}, {:.6g}) m, "
          "expected a corner that is rounded by as much or more, or a sharp edge",
          ridge.radius, corner.centre.x(), corner.centre.y()));
    Ridge<3> point{.path = Ridge<3>::Path::corner, .section = {}};
    point.origin = in_space(mitre(corner, d), ridge.centre.y());
    const auto add = [&](const Vec2& in_plan, const Vec2& in_section) {
      const Vec3 n = in_space(in_section.x() * in_plan, in_section.y());
      const auto same = [&](const Vec3& other) { return (other - n).norm() < least_turn; };
      if (std::none_of(point.cone.begin(), point.cone.end(), same)) point.cone.push_back(n);
    };
    add(corner.before, ridge.first), add(corner.before, last);
    add(corner.after, last), add(corner.after, ridge.first);
    if (point.cone.size() < 3) return;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& n : point.cone) middle += n;
    if (point.cone[0].cross(point.cone[1]).dot(middle) < 0.0)
      std::reverse(point.cone.begin(), point.cone.end());
    found_.push_back(std::move(point));
  }

  void along_arc(const Ridge<2>& ridge, const Bend& arc) {
    const double side = arc.turn > 0.0 ? 1.0 : -1.0;
    double radius = arc.radius + side * ridge.centre.x();
    if (std::abs(radius) <= tolerance_) radius = 0.0;
    if (radius < 0.0) {
      if (side * ridge.first.x() < least_turn && side * last_normal(ridge).x() < least_turn) return;
      throw InputError(fmt::format(
          "an edge of a tool is {:.6g} m from its outline, expected no more than the radius of {:.6g} m that "
          "the outline has about ({:.6g}, {:.6g}) m",
          std::abs(ridge.centre.x()), arc.radius, arc.centre.x(), arc.centre.y()));
    }
    Ridge<3> round{.path = Ridge<3>::Path::circular, .section = side > 0.0 ? ridge : mirrored(ridge)};
    round.section.centre.x() = radius;
    round.origin = in_space(arc.centre, 0.0);
    round.u = side > 0.0 ? in_space(arc.before, 0.0) : in_space(-arc.after, 0.0);
    round.length = std::abs(arc.turn);
    found_.push_back(std::move(round));
  }

  /// A corner of the outline moved by d to its inner side.
  static Vec2 mitre(const Bend& corner, double d) {
    return corner.centre + d / (1.0 + corner.before.dot(corner.after)) * (corner.before + corner.after);
  }

  /// Corners and arcs of the outline where a straight piece of the section goes by.
  void across_piece(const CurvePiece& piece) {
    const Vec2 normal = right_normal(piece.tangent(0.0));
    if (std::abs(normal.x()) < least_turn) return;
    if (std::max(piece.from.x(), piece.to.x()) < -deepest_ - tolerance_) return;
    const double side = normal.x() > 0.0 ? 1.0 : -1.0;
    const bool upright = std::abs(piece.to.x() - piece.from.x()) <= tolerance_;
    const double d = piece.from.x(), top = std::max(piece.from.y(), piece.to.y()),
                 height = std::abs(piece.to.y() - piece.from.y());
    const auto add_upright = [&](const Bend& bend, double radius) {
      Ridge<3> ridge{.path = Ridge<3>::Path::straight, .section = {}};
      ridge.origin = in_space(bend.centre, top);
      ridge.v = {0, 1, 0}; // with u = x: down from the top
      const Vec2 first = side > 0.0 ? bend.before : Vec2(-bend.after);
      ridge.section = {{0, 0}, radius, first, std::abs(bend.turn)};
      ridge.length = height;
      found_.push_back(std::move(ridge));
    };
    for (const Bend& arc : arc_)
      if (const double radius = arc.radius + side * d;
          side * arc.turn > 0.0 && upright && radius > tolerance_)
        add_upright(arc, radius);
    for (const Bend& corner : corner_) {
      if (side * corner.turn < least_turn) continue;
      const double out = std::max(side * piece.from.x(), side * piece.to.x());
      if (out <= tolerance_)
        found_.push_back(mitred(piece, corner, normal));
      else if (upright)
        add_upright(corner, side * d);
    }
  }

  Ridge<3> mitred(const CurvePiece& piece, const Bend& corner, const Vec2& normal) const {
    const Vec3 one = in_space(normal.x() * corner.before, normal.y()),
               other = in_space(normal.x() * corner.after, normal.y());
    Vec3 start = in_space(mitre(corner, piece.from.x()), piece.from.y()),
         stop = in_space(mitre(corner, piece.to.x()), piece.to.y());
    const Vec3 tangent = other.cross(one).normalized();
    if ((stop - start).dot(tangent) < 0.0) std::swap(start, stop);
    Ridge<3> ridge{.path = Ridge<3>::Path::straight, .section = {}};
    ridge.origin = start;
    ridge.u = one;
    ridge.v = one.cross(tangent);
    ridge.section = {{0, 0}, 0.0, {1, 0}, std::acos(std::clamp(one.dot(other), -1.0, 1.0))};
    ridge.length = (stop - start).norm();
    return ridge;
  }

  const Curve& outline_;
  const CurveShape& section_;
  double tolerance_ = 0.0, deepest_ = 0.0; ///< m
  std::vector<Bend> corner_, arc_;
  std::vector<Ridge<3>> found_;
};

} // namespace

std::vector<Ridge<3>> swept_ridges(const CurveShape* outline, const CurveShape& section) {
  if (outline) return Sweep(*outline, section).ridges();
  std::vector<Ridge<3>> found;
  const Box<2> box = section.bounds();
  const double tolerance = 1e-9 * (box.high - box.low).norm();
  for (Ridge<2> ridge : section.ridges()) {
    if (std::abs(ridge.centre.x()) <= tolerance) {
      ridge.centre.x() = 0.0;
      const Vec2 middle = Eigen::Rotation2Dd(0.5 * ridge.angle) * ridge.first;
      if (middle.x() < -least_turn) continue; // of the image behind the axis
    }
    if (ridge.centre.x() < 0.0) continue;
    found.push_back({.path = Ridge<3>::Path::circular, .section = ridge, .length = full_turn});
  }
  return found;
}

} // namespace cnem::contact
