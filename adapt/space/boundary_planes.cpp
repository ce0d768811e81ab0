#include "adapt/space/boundary_planes.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <Eigen/Geometry>
#include <optional>

namespace cnem::adapt {

BoundaryPlanes::BoundaryPlanes(const Cloud<3>& cloud)
    : around_(group_by_cell<CloudFacetIndex>(
          cloud.position.size(), cloud.facets.size(), [&](std::size_t f) -> const auto& {
            return cloud.facets[as<CloudFacetIndex>(f)].node;
          })) {
  constexpr double flat = 1e-7; // sine of an angle
  const voronoi::SurfaceEdges across = voronoi::surface_edges(cloud);
  IndexedVector<CloudFacetIndex, Vec3> normal;
  for (const auto& facet : cloud.facets)
    normal.push_back(area_normal<3>(corners_of<3>(facet, cloud.position)).normalized());
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    bool plane = false;
    for (const voronoi::SurfaceEdge e : across[f]) {
      const CloudFacetIndex g = voronoi::facet_of(e);
      plane |= cloud.facets[g].piece == cloud.facets[f].piece && normal[g].cross(normal[f]).norm() < flat &&
               normal[g].dot(normal[f]) > 0.0;
    }
    plane_.push_back(plane ? normal[f] : Vec3(Vec3::Zero()));
  }
}

Vec3 BoundaryPlanes::keep(std::span<const CloudFacetIndex> facets, const Vec3& way) const {
  constexpr double parallel = 1e-6; // sine of an angle
  std::optional<Vec3> one, line;
  for (const CloudFacetIndex f : facets) {
    const Vec3& n = plane_[f];
    if (n.isZero()) continue;
    if (!one) {
      one = n;
    } else if (const Vec3 cross = one->cross(n); cross.norm() > parallel) {
      if (line && line->cross(cross.normalized()).norm() > parallel) return Vec3::Zero();
      line = cross.normalized();
    }
  }
  if (line) return way.dot(*line) * *line;
  if (one) return way - way.dot(*one) * *one;
  return way;
}

} // namespace cnem::adapt
