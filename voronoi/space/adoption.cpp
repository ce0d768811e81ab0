#include "voronoi/space/adoption.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/space/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cnem::voronoi {

namespace {

constexpr double flat_height = 1e-7; // of the longest edge

/// Facets around each node, of those at one place together.
struct Fans {
  std::vector<std::uint32_t> begin;
  std::vector<CloudFacetIndex> facet;

  Fans(const Cloud<3>& cloud, const IndexedVector<NodeIndex, NodeIndex>& first)
      : begin(cloud.position.size() + 2, 0), facet(3 * cloud.facets.size()) {
    for (const auto& f : cloud.facets)
      for (const NodeIndex i : f.node) ++begin[index_of(first[i]) + 2];
    for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
    for (const CloudFacetIndex f : cloud.facets.indices())
      for (const NodeIndex i : cloud.facets[f].node) facet[begin[index_of(first[i]) + 1]++] = f;
  }
  std::span<const CloudFacetIndex> around(NodeIndex i) const {
    return std::span(facet).subspan(begin[index_of(i)], begin[index_of(i) + 1] - begin[index_of(i)]);
  }
};

std::array<Vec3, 4> corners(const Cloud<3>& cloud, const std::array<NodeIndex, 4>& node) {
  return {cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]], cloud.position[node[3]]};
}

double longest_edge(const std::array<Vec3, 4>& x) {
  double longest = 0.0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (x[a] - x[b]).squaredNorm());
  return std::sqrt(longest);
}

/// Whether a flat tetrahedron lies on a facet: all corners on its plane, the centroid in it.
bool lies_on(const std::array<Vec3, 4>& x, double length, const std::array<Vec3, 3>& facet) {
  const Vec3 normal = area_normal<3>(facet);
  const double area = normal.norm();
  for (const Vec3& corner : x)
    if (std::abs(normal.dot(corner - facet[0])) > flat_height * length * area) return false;
  const Vec3 centre = (x[0] + x[1] + x[2] + x[3]) / 4.0;
  for (std::size_t k = 0; k < 3; ++k)
    if (normal.dot((facet[(k + 1) % 3] - facet[k]).cross(centre - facet[k])) < -1e-6 * area * area)
      return false;
  return true;
}

double distance_to(const std::array<Vec3, 3>& facet, const Vec3& x) {
  const Vec3 normal = area_normal<3>(facet).normalized();
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = facet[(k + 1) % 3] - facet[k], to = x - facet[k];
    if (normal.dot(edge.cross(to)) < 0.0) inside = false;
    const double s = std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to - s * edge).norm());
  }
  return inside ? std::abs(normal.dot(x - facet[0])) : nearest;
}

PieceIndex inherited_piece(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& gone,
                           const std::array<NodeIndex, 3>& node) {
  const Facet<3> facet{node, {}};
  const std::array<Vec3, 3> x = corners_of(facet, cloud.position);
  const Vec3 centre = (x[0] + x[1] + x[2]) / 3.0, normal = area_normal<3>(x).normalized();
  PieceIndex best{};
  double least = std::numeric_limits<double>::infinity();
  for (const CloudFacetIndex f : gone) {
    const std::array<Vec3, 3> y = corners_of(cloud.facets[f], cloud.position);
    const double turned = 1.0 - normal.dot(area_normal<3>(y).normalized());
    const double far = distance_to(y, centre) + turned * std::sqrt(area_normal<3>(x).norm());
    if (far < least) least = far, best = cloud.facets[f].piece;
  }
  return best;
}

} // namespace

IndexedVector<SimplexIndex, std::uint8_t> inside_by_winding(const Cloud<3>& cloud, const Delaunay& mesh) {
  const Winding winding(cloud);
  const Fans fans(cloud, mesh.first);
  IndexedVector<SimplexIndex, std::uint8_t> inside(mesh.node.size(), 0);
  for (const SimplexIndex t : mesh.node.indices()) {
    const std::array<Vec3, 4> x = corners(cloud, mesh.node[t]);
    const double length = longest_edge(x);
    if (6.0 * measure<3>(x) < flat_height * length * length * length) {
      bool on_face = false;
      for (const NodeIndex i : mesh.node[t])
        for (const CloudFacetIndex f : fans.around(i))
          on_face = on_face || lies_on(x, length, corners_of(cloud.facets[f], cloud.position));
      if (on_face) continue;
    }
    inside[t] = winding((x[0] + x[1] + x[2] + x[3]) / 4.0) > 0;
  }
  return inside;
}

Adopted adopted_facets(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
                       const IndexedVector<SimplexIndex, std::uint8_t>& inside) {
  const auto outermost = [&](SimplexIndex t, std::size_t k) {
    return !exists(mesh.neighbour[t][k]) || !inside[mesh.neighbour[t][k]];
  };
  const auto facet_across = [&](SimplexIndex t, std::size_t k) {
    const SimplexIndex next = mesh.neighbour[t][k];
    std::size_t back = 0;
    while (mesh.neighbour[next][back] != t) ++back;
    return walls.facet[next][back];
  };
  Walls held{walls.facet, walls.blocked, {}, {}};
  IndexedVector<CloudFacetIndex, std::uint8_t> kept(cloud.facets.size(), 0);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; walls.blocked[t] && k < 4; ++k) {
      auto& f = held.facet[t][k];
      if (!inside[t] || (exists(f) && !outermost(t, k) && !exists(facet_across(t, k))))
        f = CloudFacetIndex::none;
      if (exists(f))
        kept[f] = 1;
      else
        held.blocked[t] &= static_cast<std::uint8_t>(~(1U << k));
    }

  Adopted result;
  const auto own = own_nodes(cloud, mesh, held, inside);
  std::vector<std::array<NodeIndex, 3>> fresh;
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; inside[t] && k < 4; ++k)
      if (outermost(t, k) && !exists(held.facet[t][k])) {
        const auto& [a, b, c] = face_of_tetrahedron[k];
        std::array node{own[t][a], own[t][b], own[t][c]};
        std::rotate(node.begin(), std::min_element(node.begin(), node.end()), node.end());
        fresh.push_back(node);
      }
  std::sort(fresh.begin(), fresh.end());

  std::vector<CloudFacetIndex> gone;
  for (const CloudFacetIndex f : kept.indices())
    if (kept[f])
      result.facets.push_back(cloud.facets[f]);
    else
      gone.push_back(f);
  for (const auto& node : fresh) result.facets.push_back({node, inherited_piece(cloud, gone, node)});
  result.replaced = as<int>(fresh.size());
  return result;
}

} // namespace cnem::voronoi
