#pragma once
// Whether outlines are simple, and where points lie relative to them. Pieces are exact segments and arcs of
// at most half a turn.
#include "core/geometry/curve.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

/// A point as messages write it: "(0.01, 0.005) m".
std::string show(const Vec2& x);
std::string show(const Vec3& x);

/// Lower left and upper right corner of the box round points on the curve, m. Expects pieces.
std::array<Vec2, 2> bounds(const Curve& curve);

/// Diagonal of bounds(), m: what tolerances are relative to; 0 without pieces.
double extent(const Curve& curve);

/// Points where two pieces meet, closer than `tolerance` (m): crossings, touching ends, ends of overlaps.
std::vector<Vec2> meeting_points(const CurvePiece& a, const CurvePiece& b, double tolerance);

/// A point where the curve meets itself other than where consecutive pieces join; nothing when it is simple.
std::optional<Vec2> self_crossing(const Curve& curve);

/// A point where two curves meet; nothing when they are apart.
std::optional<Vec2> common_point(const Curve& a, const Curve& b);

/// Distance from x to the nearest point of the curve, m.
double distance(const Curve& curve, const Vec2& x);

/// Whether x lies inside a closed curve, whatever its sense. Undecided within rounding of the curve itself.
bool inside(const Curve& curve, const Vec2& x);

} // namespace cnem::input
