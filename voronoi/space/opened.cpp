#include "voronoi/space/opened.hpp"

#include "core/error.hpp"
#include "core/geometry/box_tree.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/triangle_foot.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/exact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cnem::voronoi {

namespace {

constexpr double closed = 0.05;               ///< of an edge: a gap at which faces touch
constexpr std::array open = {0.4, 0.25, 0.6}; ///< what it is opened to, the next where that does not do
constexpr double behind = 3.0;                ///< as deep as nodes go with a face
constexpr double facing = -0.5; ///< cosine between normals below which two facets look at each other

class OpenedBody {
public:
  explicit OpenedBody(const Cloud<3>& cloud)
      : cloud_(cloud),
        around_(group_by_cell<CloudFacetIndex>(
            cloud.position.size(), cloud.facets.size(),
            [&](std::size_t f) -> const auto& { return cloud.facets[as<CloudFacetIndex>(f)].node; })),
        edge_(cloud.position.size(), 0.0) {
    std::vector<Box<3>> boxes;
    for (const CloudFacetIndex f : cloud.facets.indices()) {
      const auto corner = corners(f);
      normal_.push_back(area_normal<3>(corner).normalized());
      boxes.push_back(box_of<3>(corner));
    }
    tree_ = BoxTree(std::move(boxes));
    for (const NodeIndex i : edge_.indices()) {
      double sum = 0.0;
      for (const CloudFacetIndex f : around_.of(i))
        for (const NodeIndex k : cloud.facets[f].node) sum += (cloud.position[k] - cloud.position[i]).norm();
      if (!inside(i)) edge_[i] = sum / (2.0 * static_cast<double>(around_.of(i).size()));
    }
  }

  bool touches(const std::vector<CloudFacetIndex>& facets) const {
    return std::any_of(facets.begin(), facets.end(), [&](CloudFacetIndex f) {
      const auto& node = cloud_.facets[f].node;
      return std::any_of(node.begin(), node.end(),
                         [&](NodeIndex i) { return gap_at(i, closed * edge_[i]).has_value(); });
    });
  }

  /// opening: of an edge.
  void set_apart(double opening) {
    way_.assign(cloud_.position.size(), Vec3::Zero());
    foot_.resize(cloud_.position.size());
    for (const NodeIndex i : way_.indices()) {
      if (inside(i)) {
        foot_[i] = foot_of(i);
      } else if (const auto gap = gap_at(i, opening * edge_[i])) {
        way_[i] = -0.5 * (opening * edge_[i] - gap->width) * gap->outwards;
      }
    }
  }

  /// None where it crosses itself.
  std::optional<Cloud<3>> places() {
    constexpr int rounds = 20;
    for (int n = 0; n < rounds; ++n) {
      Cloud<3> moved = cloud_;
      for (const NodeIndex i : way_.indices()) moved.position[i] += way_of(i);
      const auto pairs = crossings(moved);
      if (pairs.empty()) return moved;
      bool any = false;
      for (const auto& pair : pairs)
        for (const CloudFacetIndex f : pair)
          for (const NodeIndex i : cloud_.facets[f].node) any = leave(i) || any;
      if (!any) break;
    }
    return std::nullopt;
  }

  /// Leaves closed what belongs to tetrahedra without volume at the true places. Whether there are any.
  bool leave_without_volume(const Tetrahedra& mesh, const Cloud<3>& moved) {
    bool any = false;
    for (const auto& node : mesh.node) {
      const auto corners = [&](const Cloud<3>& cloud) {
        return std::array{cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]],
                          cloud.position[node[3]]};
      };
      const std::array<Vec3, 4> place = corners(cloud_);
      if (orientation(place[0], place[1], place[2], place[3]) > 0 &&
          (!is_flat(place) || is_flat(corners(moved))))
        continue;
      any = true;
      for (const NodeIndex i : node) leave(i);
    }
    return any;
  }

private:
  bool inside(NodeIndex i) const { return around_.of(i).empty(); }
  std::array<Vec3, 3> corners(CloudFacetIndex f) const {
    return corners_of<3>(cloud_.facets[f], cloud_.position);
  }

  struct Gap {
    double width;  ///< m
    Vec3 outwards; ///< –, across it, out of the node's own facets
  };
  struct FootOfNode {
    CloudFacetIndex facet{};
    std::array<double, 3> weight{};
    double depth = 0.0; ///< in edges of the facet
  };

  /// To the nearest face that looks at a node of the surface, within reach (m).
  std::optional<Gap> gap_at(NodeIndex i, double reach) const {
    const Vec3& x = cloud_.position[i];
    std::optional<Gap> nearest;
    tree_.overlapping({x.array() - reach, x.array() + reach}, [&](std::int32_t t) {
      const auto other = as<CloudFacetIndex>(t);
      const auto& node = cloud_.facets[other].node;
      if (std::find(node.begin(), node.end(), i) != node.end()) return;
      const Vec3 to = foot_on_triangle(corners(other), x).point - x;
      const double width = to.norm();
      constexpr double rounding = 1e-3; // of the reach, by which the node may be beyond the face
      if (!(width < (nearest ? nearest->width : reach)) || normal_[other].dot(to) > rounding * reach) return;
      Vec3 outwards = Vec3::Zero();
      for (const CloudFacetIndex f : around_.of(i))
        if (normal_[f].dot(normal_[other]) < facing) outwards += normal_[f];
      if (!outwards.isZero()) nearest = {width, outwards.normalized()};
    });
    return nearest;
  }

  FootOfNode foot_of(NodeIndex i) const {
    const Vec3& x = cloud_.position[i];
    double least = std::numeric_limits<double>::infinity();
    const auto f = as<CloudFacetIndex>(tree_.nearest(
        x,
        [&](std::int32_t t) {
          return (x - foot_on_triangle(corners(as<CloudFacetIndex>(t)), x).point).squaredNorm();
        },
        least));
    double edge = 0.0;
    for (const NodeIndex k : cloud_.facets[f].node) edge += edge_[k] / 3.0;
    return {f, foot_on_triangle(corners(f), x).weight, std::sqrt(least) / edge};
  }

  /// Nodes inside go with the face that is nearest to them, the less the deeper they are.
  Vec3 way_of(NodeIndex i) const {
    if (!inside(i)) return way_[i];
    const FootOfNode& foot = foot_[i];
    Vec3 way = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) way += foot.weight[k] * way_[cloud_.facets[foot.facet].node[k]];
    return std::max(0.0, 1.0 - foot.depth / behind) * way;
  }

  /// Whether it, or what it goes with, was to move.
  bool leave(NodeIndex i) {
    if (inside(i)) {
      bool any = false;
      for (const NodeIndex k : cloud_.facets[foot_[i].facet].node) any = leave(k) || any;
      return any;
    }
    if (way_[i].isZero(0.0)) return false;
    way_[i].setZero();
    return true;
  }

  const Cloud<3>& cloud_;
  BoxTree tree_;                                ///< of the facets
  IndexedVector<CloudFacetIndex, Vec3> normal_; ///< –, unit, outwards
  CellLists<CloudFacetIndex> around_;           ///< of each node; none: inside
  IndexedVector<NodeIndex, double> edge_;       ///< m, mean length of edges of the surface
  IndexedVector<NodeIndex, Vec3> way_;          ///< m, of nodes of the surface
  IndexedVector<NodeIndex, FootOfNode> foot_;   ///< of nodes inside
};

} // namespace

bool faces_touch(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost) {
  return !lost.empty() && cloud.twins.empty() && OpenedBody(cloud).touches(lost);
}

std::optional<Filling> filling_of_opened(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost) {
  if (!faces_touch(cloud, lost)) return std::nullopt;
  OpenedBody body(cloud);
  constexpr int attempts = 6;
  for (const double opening : open) try {
      body.set_apart(opening);
      for (int n = 0; n < attempts; ++n) {
        const std::optional<Cloud<3>> moved = body.places();
        if (!moved) break;
        Delaunay mesh = delaunay(*moved);
        Walls walls = find_walls(*moved, mesh);
        Filling result = held_filling(*moved, std::move(mesh), std::move(walls));
        if (body.leave_without_volume(result.tetrahedra, *moved)) continue;
        result.flipped = true;
        return result;
      }
    } catch (const GeometryError&) {} // it is not recovered when opened either
  return std::nullopt;
}

} // namespace cnem::voronoi
