#pragma once
// Bodies of revolution: x is the radius r, y the axial coordinate, x = 0 the axis.
#include "core/vec.hpp"

#include <array>
#include <numbers>

namespace cnem {

/// What a plane cloud stands for: a slice of unit thickness, or the meridian plane of a body of revolution.
/// Volumes, masses, forces and energies are per metre of thickness in the one, totals in the other.
enum class Space { plane, revolution };

/// Shares ∫ φ dΓ of the two ends in the area of a straight facet, φ linear along it: m (per unit thickness)
/// for plane bodies, m² for bodies of revolution.
inline std::array<double, 2> end_areas(Space space, const Vec2& a, const Vec2& b) {
  const double length = (b - a).norm();
  if (space == Space::plane) return {0.5 * length, 0.5 * length};
  const double third = std::numbers::pi / 3.0 * length;
  return {third * (2.0 * a.x() + b.x()), third * (a.x() + 2.0 * b.x())};
}

/// π ∫ r² dy over a straight facet, m³: what it adds to the volume that a closed boundary turns about the
/// axis.
inline double revolved_volume(const Vec2& a, const Vec2& b) {
  const double mean_square = (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 3.0;
  return std::numbers::pi * mean_square * (b.y() - a.y());
}

} // namespace cnem
