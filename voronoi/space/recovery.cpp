#include "voronoi/space/recovery.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/space/adoption.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/space/surface_flips.hpp"
#include "voronoi/space/walls.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

std::vector<std::uint8_t> on_surface(const Cloud<3>& cloud) {
  std::vector<std::uint8_t> is(cloud.position.size(), 0);
  for (const auto& facet : cloud.facets)
    for (const NodeIndex i : facet.node) is[index_of(i)] = 1;
  return is;
}

struct Ball {
  Vec3 centre;
  double square; ///< of the radius
};

/// The smallest ball with the corners of a facet on it.
Ball diametral_ball(const std::array<Vec3, 3>& x) {
  const Vec3 u = x[1] - x[0], v = x[2] - x[0], n = u.cross(v);
  const Vec3 to = (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
  return {x[0] + to, to.squaredNorm()};
}

class Recovery {
public:
  Recovery(const Cloud<3>& cloud, const RecoveryRules& rules) : rules_(rules) {
    result_.cloud = cloud;
    result_.now.resize(cloud.position.size());
    for (const NodeIndex i : result_.now.indices()) result_.now[i] = i;
  }

  RecoveredBoundary run() {
    Cloud<3>& cloud = result_.cloud;
    result_.counts.flipped = flip_surface(cloud, rules_.flat_angle);
    Delaunay mesh = delaunay(cloud);
    Walls walls = find_walls(cloud, mesh);
    result_.counts.lost = as<int>(walls.lost.size());
    while (!walls.lost.empty() && remove_near(walls.lost)) {
      mesh = delaunay(cloud);
      walls = find_walls(cloud, mesh);
    }
    if (!walls.lost.empty()) {
      const Adopted adopted = adopted_facets(cloud, mesh, walls, inside_by_winding(cloud, mesh));
      const auto nodes = on_surface(cloud);
      cloud.facets = adopted.facets;
      result_.counts.replaced = adopted.replaced;
      surface_edges(cloud);
      if (on_surface(cloud) != nodes) throw GeometryError("other nodes");
      walls = find_walls(cloud, mesh);
    }
    if (!walls.lost.empty()) throw GeometryError("lost");
    result_.tetrahedra = filling(cloud, mesh, walls, inside_of_walls(cloud, mesh, walls));
    return std::move(result_);
  }

private:
  /// Takes inner nodes out of the diametral balls of facets. Whether there were any.
  bool remove_near(const std::vector<CloudFacetIndex>& lost) {
    const Cloud<3>& cloud = result_.cloud;
    const auto surface = on_surface(cloud);
    IndexedVector<NodeIndex, std::uint8_t> goes(cloud.position.size(), 0);
    bool any = false;
    for (const CloudFacetIndex f : lost) {
      const auto& node = cloud.facets[f].node;
      const Ball ball =
          diametral_ball({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]]});
      for (const NodeIndex i : cloud.position.indices())
        if (!surface[index_of(i)] && (cloud.position[i] - ball.centre).squaredNorm() < ball.square)
          goes[i] = any = true;
    }
    if (any) remove(goes);
    return any;
  }

  void remove(const IndexedVector<NodeIndex, std::uint8_t>& goes) {
    Cloud<3>& cloud = result_.cloud;
    IndexedVector<NodeIndex, NodeIndex> number(goes.size(), NodeIndex::none);
    IndexedVector<NodeIndex, Vec3> kept;
    for (const NodeIndex i : goes.indices())
      if (!goes[i]) {
        number[i] = kept.next();
        kept.push_back(cloud.position[i]);
      } else {
        ++result_.counts.removed;
      }
    cloud.position = std::move(kept);
    cloud.simplices.clear();
    cloud.across.clear();
    for (auto& facet : cloud.facets)
      for (NodeIndex& i : facet.node) i = number[i];
    for (auto& pair : cloud.twins)
      for (NodeIndex& i : pair) i = number[i];
    for (NodeIndex& i : result_.now)
      if (exists(i)) i = number[i];
  }

  RecoveryRules rules_;
  RecoveredBoundary result_;
};

} // namespace

RecoveredBoundary recover_boundary(const Cloud<3>& cloud, const RecoveryRules& rules) {
  return Recovery(cloud, rules).run();
}

} // namespace cnem::voronoi
