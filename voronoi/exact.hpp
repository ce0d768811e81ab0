#pragma once
// Predicates whose sign is exact (CGAL's, behind exact.cpp).
#include "core/vec.hpp"

namespace cnem::voronoi {

/// 1: a, b, c run counter-clockwise; −1: clockwise; 0: they lie on one line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether d is inside the circle through a, b, c, which run counter-clockwise. Of four cocircular points one
/// pair of opposite ones is outside, always the same: that of the triangulation's symbolic perturbation
/// (Devillers, Teillaud 2011).
bool in_circle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

} // namespace cnem::voronoi
