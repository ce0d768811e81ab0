#include "adapt/space/unfold.hpp"

#include "adapt/space/boundary_planes.hpp"
#include "adapt/space/refine_surface.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace cnem::adapt {
namespace {

using Pair = std::array<CloudFacetIndex, 2>;

class Unfolding {
public:
  Unfolding(Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held, const Field& size,
            const PeriodImages& images)
      : cloud_(cloud), before_(cloud.position), held_(held), size_(size), planes_(cloud),
        groups_(images.groups()), active_(cloud.position.size(), 0) {}

  /// The number of nodes that have moved.
  int run() {
    constexpr int rounds = 36;
    for (int n = 0; n < rounds; ++n) {
      const std::vector<Pair> pairs = voronoi::crossings(cloud_);
      if (pairs.empty()) break;
      for (const Pair& pair : pairs)
        for (const CloudFacetIndex f : pair)
          for (const NodeIndex i : cloud_.facets[f].node) active_[i] = 1;
      constexpr int widen_every = 3;
      if (n % widen_every == widen_every - 1) widen();
      push_apart(pairs);
      align();
      smooth();
      align();
    }
    int moved = 0;
    for (const NodeIndex i : cloud_.position.indices()) moved += cloud_.position[i] != before_[i];
    return moved;
  }

  const IndexedVector<NodeIndex, char>& active() const { return active_; }

private:
  using Corners = std::array<Vec3, 3>;

  Vec3 normal(CloudFacetIndex f) const {
    return area_normal<3>(corners_of<3>(cloud_.facets[f], cloud_.position));
  }

  void widen() {
    IndexedVector<NodeIndex, char> wider = active_;
    for (const auto& facet : cloud_.facets)
      if (active_[facet.node[0]] || active_[facet.node[1]] || active_[facet.node[2]])
        for (const NodeIndex i : facet.node) wider[i] = 1;
    active_ = std::move(wider);
  }

  void move(NodeIndex i, const Vec3& way) {
    constexpr double farthest = 0.5; // h
    if (held_[i]) return;
    Vec3 from_start = cloud_.position[i] + planes_.keep(i, way) - before_[i];
    const double most = farthest * size_[index_of(i)];
    if (from_start.norm() > most) from_start *= most / from_start.norm();
    cloud_.position[i] = before_[i] + from_start;
  }

  /// Images take the mean of their ways.
  void align() {
    for (const std::vector<NodeIndex>& group : groups_) {
      Vec3 way = Vec3::Zero();
      bool held = false;
      for (const NodeIndex i : group) {
        way += (cloud_.position[i] - before_[i]) / static_cast<double>(group.size());
        held = held || held_[i];
      }
      for (const NodeIndex i : group) cloud_.position[i] = held ? before_[i] : Vec3(before_[i] + way);
    }
  }

  bool share_a_node(const Pair& pair) const {
    for (const NodeIndex i : cloud_.facets[pair[0]].node)
      for (const NodeIndex k : cloud_.facets[pair[1]].node)
        if (i == k) return true;
    return false;
  }

  /// How deep the corners of f are below the plane of g, m.
  double depth(CloudFacetIndex f, CloudFacetIndex g) const {
    const Vec3 n = normal(g).normalized();
    double deepest = 0.0;
    for (const NodeIndex i : cloud_.facets[f].node)
      deepest = std::max(deepest, -n.dot(cloud_.position[i] - cloud_.position[cloud_.facets[g].node[0]]));
    return deepest;
  }

  /// Facets that look at each other go apart along the normal of the one that is entered less deep.
  void push_apart(const std::vector<Pair>& pairs) {
    IndexedVector<NodeIndex, Vec3> way(cloud_.position.size(), Vec3::Zero());
    constexpr double at_once = 0.1; // h
    for (const Pair& pair : pairs) {
      const auto [f, g] = pair;
      if (share_a_node(pair) || !(normal(f).dot(normal(g)) < 0.0)) continue;
      const double into_g = depth(f, g), into_f = depth(g, f);
      const Vec3 n = into_g < into_f ? normal(g).normalized() : Vec3(-normal(f).normalized());
      const double h = size_[index_of(cloud_.facets[f].node[0])];
      constexpr double more = 1.2; // than half of it each, to be apart at the end
      const Vec3 step = std::min(0.5 * more * std::min(into_f, into_g), at_once * h) * n;
      for (const NodeIndex i : cloud_.facets[f].node)
        if (step.norm() > way[i].norm()) way[i] = step;
      for (const NodeIndex i : cloud_.facets[g].node)
        if (step.norm() > way[i].norm()) way[i] = -step;
    }
    for (const NodeIndex i : cloud_.position.indices())
      if (!way[i].isZero()) move(i, way[i]);
  }

  void smooth() {
    const auto x = cloud_.position;
    for (const NodeIndex i : x.indices()) {
      if (!active_[i]) continue;
      Vec3 sum = Vec3::Zero();
      double count = 0.0;
      for (const CloudFacetIndex f : planes_.around(i))
        for (const NodeIndex k : cloud_.facets[f].node)
          if (k != i) {
            sum += x[k];
            count += 1.0;
          }
      constexpr double share = 0.5;
      if (count > 0.0) move(i, share * (sum / count - x[i]));
    }
  }

  Cloud<3>& cloud_;
  IndexedVector<NodeIndex, Vec3> before_;
  const IndexedVector<NodeIndex, char>& held_;
  const Field& size_;
  BoundaryPlanes planes_;
  std::vector<std::vector<NodeIndex>> groups_; ///< of images
  IndexedVector<NodeIndex, char> active_;      ///< nodes that are smoothed
};

} // namespace

void unfold(Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held, const Field& size,
            const PeriodImages& images, const SurfaceRules& rules, PassReport& report) {
  const double volume = enclosed_measure(cloud);
  Unfolding unfolding(cloud, held, size, images);
  report.folded += unfolding.run();
  std::vector<NodeIndex> owing;
  for (const NodeIndex i : cloud.position.indices())
    if (unfolding.active()[i]) owing.push_back(i);
  if (owing.empty()) return;
  Field debt(cloud.position.size(), 0.0);
  for (const NodeIndex i : owing)
    debt[index_of(i)] = (volume - enclosed_measure(cloud)) / static_cast<double>(owing.size());
  WorkingSurface surface(cloud, held, rules);
  give_back(surface, std::move(debt), size, SurfaceThresholds{}.give_back);
  Cloud<3> swollen = cloud;
  for (const NodeIndex i : cloud.position.indices()) swollen.position[i] = surface.at(i);
  if (voronoi::crossings(swollen).size() <= voronoi::crossings(cloud).size()) cloud = std::move(swollen);
}

} // namespace cnem::adapt
