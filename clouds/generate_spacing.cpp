#include "clouds/generate.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::clouds {

namespace {

double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (x - a - s * ab).norm();
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

} // namespace

double Refinement::distance(const Vec2& x) const {
  if (region == Region::box) {
    const Vec2 low = points[0].cwiseMin(points[1]), high = points[0].cwiseMax(points[1]);
    return (x - x.cwiseMax(low).cwiseMin(high)).norm();
  }
  if (points.size() == 1) return (x - points[0]).norm();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < points.size(); ++k)
    nearest = std::min(nearest, distance_to_segment(x, points[k - 1], points[k]));
  return nearest;
}

double SpacingField::at(const Vec2& x) const {
  double h = spacing;
  for (const Refinement& r : refinements)
    if (r.spacing < h) h = std::min(h, r.spacing + r.growth * r.distance(x));
  return h;
}

bool SpacingField::uniform() const {
  return std::ranges::all_of(refinements, [&](const Refinement& r) { return r.spacing >= spacing; });
}

void SpacingField::check() const {
  if (!positive(spacing))
    throw SpacingError(fmt::format("the spacing is {} m; expected a positive length", spacing));
  for (std::size_t k = 0; k < refinements.size(); ++k) {
    const Refinement& r = refinements[k];
    if (!positive(r.spacing))
      throw SpacingError(
          fmt::format("refinement {}: the spacing is {} m; expected a positive length", k + 1, r.spacing));
    if (!(r.growth > 0.0 && r.growth <= 1.0))
      throw SpacingError(
          fmt::format("refinement {}: the growth is {}; expected a number in (0, 1]", k + 1, r.growth));
    const bool box = r.region == Refinement::Region::box;
    if (box ? r.points.size() != 2 : r.points.empty())
      throw SpacingError(fmt::format("refinement {}: {} points given; expected {}", k + 1, r.points.size(),
                                     box ? "two opposite corners" : "at least one"));
    for (const Vec2& x : r.points)
      if (!x.allFinite())
        throw SpacingError(
            fmt::format("refinement {}: the point ({}, {}) is not finite", k + 1, x.x(), x.y()));
  }
}

} // namespace cnem::clouds
