#include "adapt/space/boundary_planes.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <optional>
#include <utility>
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

namespace {

using Normals = IndexedVector<CloudFacetIndex, Vec3>;

bool parallel(const Vec3& a, const Vec3& b) {
  constexpr double flat = 1e-7; // sine of an angle
  return a.cross(b).norm() < flat && a.dot(b) > 0.0;
}

bool same_plane_beside(const Cloud<3>& cloud, const voronoi::SurfaceEdges& across, const Normals& normal,
                       CloudFacetIndex f) {
  return std::any_of(across[f].begin(), across[f].end(), [&](voronoi::SurfaceEdge e) {
    const CloudFacetIndex g = voronoi::facet_of(e);
    return cloud.facets[g].piece == cloud.facets[f].piece && parallel(normal[g], normal[f]);
  });
}

/// [facet] whether its piece is plane.
IndexedVector<CloudFacetIndex, char> of_plane_pieces(const Cloud<3>& cloud, const Normals& normal) {
  std::map<PieceIndex, std::pair<Vec3, bool>> pieces; // the first normal, whether all are alike
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    auto& [first, alike] = pieces.try_emplace(cloud.facets[f].piece, normal[f], true).first->second;
    alike = alike && parallel(normal[f], first);
  }
  IndexedVector<CloudFacetIndex, char> is;
  for (const auto& facet : cloud.facets) is.push_back(pieces.at(facet.piece).second);
  return is;
}

} // namespace

BoundaryPlanes::BoundaryPlanes(const Cloud<3>& cloud, Plane plane)
    : around_(group_by_cell<CloudFacetIndex>(
          cloud.position.size(), cloud.facets.size(), [&](std::size_t f) -> const auto& {
            return cloud.facets[as<CloudFacetIndex>(f)].node;
          })) {
  const voronoi::SurfaceEdges across = voronoi::surface_edges(cloud);
  Normals normal;
  for (const auto& facet : cloud.facets)
    normal.push_back(area_normal<3>(corners_of<3>(facet, cloud.position)).normalized());
  const auto of_piece = of_plane_pieces(cloud, normal);
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const bool is = plane == Plane::piece ? of_piece[f] != 0 : same_plane_beside(cloud, across, normal, f);
    plane_.push_back(is ? normal[f] : Vec3(Vec3::Zero()));
  }
}

Vec3 BoundaryPlanes::keep(std::span<const CloudFacetIndex> facets, const Vec3& way) const {
  std::vector<Vec3> normals;
  for (const CloudFacetIndex f : facets)
    if (!plane_[f].isZero()) normals.push_back(plane_[f]);
  return within_planes(normals, way);
}

} // namespace cnem::adapt
