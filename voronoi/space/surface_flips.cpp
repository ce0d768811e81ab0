#include "voronoi/space/surface_flips.hpp"

#include "core/index.hpp"
#include "voronoi/space/exact.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cnem::voronoi {

namespace {

/// Whether the angles across from an edge are more than π together, on a plane exactly.
bool is_lengthy(const FlippableSurface& surface, SurfaceEdge e) {
  const auto& position = surface.cloud().position;
  const Vec3 &a = position[surface.start(e)], &b = position[surface.start(surface.across(e))];
  const Vec3 &c = position[surface.apex(e)], &d = position[surface.apex(surface.across(e))];
  if (orientation(a, b, c, d) == 0) return in_coplanar_circle(a, b, c, d);
  const double dot_c = (a - c).dot(b - c), dot_d = (a - d).dot(b - d);
  const double sine_c = (a - c).cross(b - c).norm(), sine_d = (a - d).cross(b - d).norm();
  return dot_c * sine_d + sine_c * dot_d < -1e-12 * (sine_c * sine_d);
}

} // namespace

int flip_surface(Cloud<3>& cloud, double flat_angle, const FixedNodes& fixed) {
  FlippableSurface surface(cloud, fixed);
  const double least_cosine = std::cos(flat_angle);
  std::vector<SurfaceEdge> stack;
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t k = 0; k < 3; ++k)
      if (edge_at(f, k) < surface.across(edge_at(f, k))) stack.push_back(edge_at(f, k));
  int flips = 0;
  for (std::size_t left = 50 * cloud.facets.size(); !stack.empty() && left > 0; --left) {
    const SurfaceEdge e = stack.back();
    stack.pop_back();
    if (!is_lengthy(surface, e)) continue;
    const CloudFacetIndex g = facet_of(surface.across(e));
    if (!surface.flip(e, least_cosine)) continue;
    ++flips;
    for (const CloudFacetIndex h : {facet_of(e), g})
      for (std::size_t k = 0; k < 3; ++k) stack.push_back(edge_at(h, k));
  }
  return flips;
}

} // namespace cnem::voronoi
