#include "voronoi/space/opened.hpp"

#include "core/error.hpp"
#include "core/geometry/surface_distance.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/exact.hpp"

#include <algorithm>
#include <utility>

namespace cnem::voronoi {

namespace {

constexpr double closed = 0.05; ///< of an edge: a gap at which faces touch
constexpr double open = 0.4;    ///< what it is opened to
constexpr double behind = 3.0;  ///< as deep as nodes go with a face
constexpr double facing = -0.5; ///< cosine between normals below which two facets look at each other

TriangleSurface surface_of(const Cloud<3>& cloud) {
  TriangleSurface surface{{cloud.position.begin(), cloud.position.end()}, {}};
  for (const auto& facet : cloud.facets) {
    auto& corner = surface.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) corner[k] = as<std::int32_t>(index_of(facet.node[k]));
  }
  return surface;
}

class OpenedBody {
public:
  explicit OpenedBody(const Cloud<3>& cloud)
      : cloud_(cloud), surface_(surface_of(cloud)), around_(cloud.position.size()),
        edge_(cloud.position.size(), 0.0) {
    for (const CloudFacetIndex f : cloud.facets.indices())
      for (const NodeIndex i : cloud.facets[f].node) around_[i].push_back(f);
    for (const NodeIndex i : around_.indices()) {
      double sum = 0.0;
      for (const CloudFacetIndex f : around_[i])
        for (const NodeIndex k : cloud.facets[f].node) sum += (cloud.position[k] - cloud.position[i]).norm();
      if (!around_[i].empty()) edge_[i] = sum / (2.0 * static_cast<double>(around_[i].size()));
    }
  }

  bool touches(const std::vector<CloudFacetIndex>& facets) const {
    return std::any_of(facets.begin(), facets.end(), [&](CloudFacetIndex f) {
      const auto& node = cloud_.facets[f].node;
      return std::any_of(node.begin(), node.end(),
                         [&](NodeIndex i) { return gap_at(i, closed * edge_[i]).has_value(); });
    });
  }

  void set_apart() {
    way_.assign(cloud_.position.size(), Vec3::Zero());
    foot_.resize(cloud_.position.size());
    for (const NodeIndex i : way_.indices()) {
      if (around_[i].empty()) {
        foot_[i] = foot_of(i);
      } else if (const auto gap = gap_at(i, open * edge_[i])) {
        way_[i] = -0.5 * (open * edge_[i] - gap->width) * gap->outwards;
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
    surface_.tree().overlapping({x.array() - reach, x.array() + reach}, [&](std::int32_t t) {
      const auto& other = cloud_.facets[as<CloudFacetIndex>(t)].node;
      if (std::find(other.begin(), other.end(), i) != other.end()) return;
      const Vec3 to = surface_.foot(index_of(t), x).point - x;
      const double width = to.norm();
      constexpr double rounding = 1e-3; // of the reach, by which the node may be beyond the face
      if (!(width < (nearest ? nearest->width : reach)) ||
          surface_.normal(index_of(t)).dot(to) > rounding * reach)
        return;
      Vec3 outwards = Vec3::Zero();
      for (const CloudFacetIndex f : around_[i])
        if (const Vec3& own = surface_.normal(index_of(f)); own.dot(surface_.normal(index_of(t))) < facing)
          outwards += own;
      if (!outwards.isZero()) nearest = {width, outwards.normalized()};
    });
    return nearest;
  }

  FootOfNode foot_of(NodeIndex i) const {
    const auto nearest = surface_.nearest(cloud_.position[i]);
    const auto f = as<CloudFacetIndex>(nearest.triangle);
    double edge = 0.0;
    for (const NodeIndex k : cloud_.facets[f].node) edge += edge_[k] / 3.0;
    return {f, surface_.foot(index_of(f), cloud_.position[i]).weight, std::abs(nearest.distance) / edge};
  }

  /// Nodes inside go with the face that is nearest to them, the less the deeper they are.
  Vec3 way_of(NodeIndex i) const {
    if (!around_[i].empty()) return way_[i];
    const FootOfNode& foot = foot_[i];
    Vec3 way = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) way += foot.weight[k] * way_[cloud_.facets[foot.facet].node[k]];
    return std::max(0.0, 1.0 - foot.depth / behind) * way;
  }

  /// Whether it, or what it goes with, was to move.
  bool leave(NodeIndex i) {
    if (around_[i].empty()) {
      bool any = false;
      for (const NodeIndex k : cloud_.facets[foot_[i].facet].node) any = leave(k) || any;
      return any;
    }
    if (way_[i].isZero(0.0)) return false;
    way_[i].setZero();
    return true;
  }

  const Cloud<3>& cloud_;
  SurfaceDistance surface_;
  IndexedVector<NodeIndex, std::vector<CloudFacetIndex>> around_; ///< empty: inside
  IndexedVector<NodeIndex, double> edge_;                         ///< m, mean length of edges of the surface
  IndexedVector<NodeIndex, Vec3> way_;                            ///< m, of nodes of the surface
  IndexedVector<NodeIndex, FootOfNode> foot_;                     ///< of nodes inside
};

} // namespace

std::optional<Filling> filling_of_opened(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost) {
  if (lost.empty() || !cloud.twins.empty()) return std::nullopt;
  OpenedBody body(cloud);
  if (!body.touches(lost)) return std::nullopt;
  body.set_apart();
  constexpr int attempts = 6;
  try {
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
