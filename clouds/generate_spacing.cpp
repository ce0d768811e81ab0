#include "clouds/generate.hpp"
#include "core/error.hpp"
#include "core/geometry/place_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::clouds {

namespace {

template<int dim> double distance_to_segment(const Vec<dim>& x, const Vec<dim>& a, const Vec<dim>& b) {
  const Vec<dim> ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (x - a - s * ab).norm();
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

} // namespace

template<int dim> double RefinementIn<dim>::distance(const Vec<dim>& x) const {
  if (region == Region::box) {
    const Vec<dim> low = points[0].cwiseMin(points[1]), high = points[0].cwiseMax(points[1]);
    return (x - x.cwiseMax(low).cwiseMin(high)).norm();
  }
  if (points.size() == 1) return (x - points[0]).norm();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < points.size(); ++k)
    nearest = std::min(nearest, distance_to_segment<dim>(x, points[k - 1], points[k]));
  return nearest;
}

template<int dim> double SpacingFieldIn<dim>::at(const Vec<dim>& x) const {
  if constexpr (dim == 2)
    if (mapped) return mapped->at(x);
  double h = spacing;
  for (const RefinementIn<dim>& r : refinements)
    if (r.spacing < h) h = std::min(h, r.spacing + r.growth * r.distance(x));
  return h;
}

template<int dim> bool SpacingFieldIn<dim>::uniform() const {
  return !mapped &&
         std::ranges::all_of(refinements, [&](const RefinementIn<dim>& r) { return r.spacing >= spacing; });
}

template<int dim> double SpacingFieldIn<dim>::finest() const {
  double least = mapped ? std::min(mapped->finest, spacing) : spacing;
  for (const RefinementIn<dim>& r : refinements) least = std::min(least, r.spacing);
  return least;
}

template<int dim> double SpacingFieldIn<dim>::growth() const {
  double steepest = mapped ? mapped->growth : 0.0;
  for (const RefinementIn<dim>& r : refinements)
    if (r.spacing < spacing) steepest = std::max(steepest, r.growth);
  return steepest;
}

template<int dim> void SpacingFieldIn<dim>::check() const {
  if (!positive(spacing))
    throw SpacingError(fmt::format("the spacing is {} m; expected a positive length", spacing));
  for (std::size_t k = 0; k < refinements.size(); ++k) {
    const RefinementIn<dim>& r = refinements[k];
    if (!positive(r.spacing))
      throw SpacingError(
          fmt::format("refinement {}: the spacing is {} m; expected a positive length", k + 1, r.spacing));
    if (!(r.growth > 0.0 && r.growth <= 1.0))
      throw SpacingError(
          fmt::format("refinement {}: the growth is {}; expected a number in (0, 1]", k + 1, r.growth));
    const bool box = r.region == RefinementIn<dim>::Region::box;
    if (box ? r.points.size() != 2 : r.points.empty())
      throw SpacingError(fmt::format("refinement {}: {} points given; expected {}", k + 1, r.points.size(),
                                     box ? "two opposite corners" : "at least one"));
    for (const Vec<dim>& x : r.points)
      if (!x.allFinite())
        throw SpacingError(fmt::format("refinement {}: the point {} is not finite", k + 1, place_text(x)));
  }
}

template struct RefinementIn<2>;
template struct RefinementIn<3>;
template struct SpacingFieldIn<2>;
template struct SpacingFieldIn<3>;

} // namespace cnem::clouds
