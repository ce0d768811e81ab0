#include "adapt/space/boundary_planes.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace cnem::adapt {

Vec3 within_planes(std::span<const Vec3> normals, const Vec3& way) {
  constexpr double parallel = 1e-6; // sine of an angle
  if (normals.empty()) return way;
  const Vec3& first = normals.front();
  std::optional<Vec3> line;
  for (const Vec3& n : normals) {
    const Vec3 cross = first.cross(n);
    if (cross.norm() <= parallel) continue;
    if (line && line->cross(cross.normalized()).norm() > parallel) return Vec3::Zero();
    line = cross.normalized();
  }
  return line ? Vec3(way.dot(*line) * *line) : Vec3(way - way.dot(first) * first);
}

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
  std::vector<Vec3> normals;
  for (const CloudFacetIndex f : facets)
    if (!plane_[f].isZero()) normals.push_back(plane_[f]);
  return within_planes(normals, way);
}

} // namespace cnem::adapt
