#include "adapt/space/unfold.hpp"

#include "adapt/space/boundary_planes.hpp"
#include "adapt/space/crossing_facets.hpp"
#include "adapt/space/refine_surface.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/crossings.hpp"
#include "voronoi/space/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace cnem::adapt {
namespace {

using Pair = CrossingFacets::Pair;

/// Nodes and those beside them on the surface.
IndexedVector<NodeIndex, char> with_neighbours(const Cloud<3>& cloud,
                                               const IndexedVector<NodeIndex, char>& nodes) {
  IndexedVector<NodeIndex, char> wider = nodes;
  for (const auto& facet : cloud.facets)
    if (nodes[facet.node[0]] || nodes[facet.node[1]] || nodes[facet.node[2]])
      for (const NodeIndex i : facet.node) wider[i] = 1;
  return wider;
}

class Unfolding {
public:
  Unfolding(Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held, const Field& size,
            const PeriodImages& images, const SurfaceRules& rules)
      : cloud_(cloud), facets_(cloud, size), before_(cloud.position), held_(held), size_(size),
        planes_(cloud), rules_(rules), groups_(images.groups()), active_(cloud.position.size(), 0),
        within_seam_(cloud.position.size(), 1) {
    for (const CloudFacetIndex f : cloud.facets.indices())
      if (!on_seam(f))
        for (const NodeIndex i : cloud.facets[f].node) within_seam_[i] = 0;
  }

  /// The number of nodes that have moved.
  int run() {
    clear_seams();
    part_touching();
    untangle();
    constexpr int rounds = 36;
    for (int n = 0; n < rounds; ++n) {
      const std::vector<Pair> pairs = voronoi::crossings(cloud_);
      if (pairs.empty()) break;
      activate(pairs);
      constexpr int widen_every = 3;
      if (n % widen_every == widen_every - 1) active_ = with_neighbours(cloud_, active_);
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
  static constexpr double each = 0.6; ///< of an overlap that either facet goes, to be apart at the end

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

  bool on_seam(CloudFacetIndex f) const { return rules_.is_still(cloud_.facets[f].piece); }

  /// Where a seam and a face have run into each other the seam goes: it is a cut through matter that goes on
  /// behind it, and its image takes what it gives.
  void clear_seams() {
    if (groups_.empty()) return;
    constexpr int rounds = 12;
    for (int n = 0;; ++n) {
      std::vector<Pair> pairs = voronoi::crossings(cloud_);
      std::erase_if(pairs, [&](const Pair& pair) { return on_seam(pair[0]) == on_seam(pair[1]); });
      if (pairs.empty()) return;
      if (n == rounds) return set_back(pairs);
      IndexedVector<NodeIndex, Vec3> way(cloud_.position.size(), Vec3::Zero());
      const voronoi::Winding winding(cloud_);
      for (const Pair& pair : pairs) leave_face(pair, facets_.were_back_to_back(pair, winding), way);
      if (!move_alike(cloud_, groups_, way, held_)) return set_back(pairs);
    }
  }

  /// Where a seam has not come off a face it is its border that is folded: it stays as it was, with all that
  /// has moved beside it and images of that.
  void set_back(const std::vector<Pair>& pairs) {
    IndexedVector<NodeIndex, char> back(cloud_.position.size(), 0);
    bool more = false;
    const auto join = [&](const auto& nodes) {
      for (const NodeIndex i : nodes)
        if (!back[i] && cloud_.position[i] != before_[i]) {
          back[i] = 1;
          more = true;
        }
    };
    const auto join_all_of = [&](const auto& nodes) {
      if (std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex i) { return back[i] != 0; })) join(nodes);
    };
    for (const Pair& pair : pairs) join(cloud_.facets[on_seam(pair[0]) ? pair[0] : pair[1]].node);
    while (std::exchange(more, false)) {
      for (const std::vector<NodeIndex>& group : groups_) join_all_of(group);
      for (const auto& facet : cloud_.facets) join_all_of(facet.node);
    }
    for (const NodeIndex i : back.indices())
      if (back[i]) cloud_.position[i] = before_[i];
  }

  /// Ways of the nodes within a seam that bring its facet off the other one: those that are nearer to that
  /// than some of h, or beyond it; where none is, all of the facet by what they have in common.
  void leave_face(const Pair& pair, bool back_to_back, IndexedVector<NodeIndex, Vec3>& way) const {
    constexpr double clearance = 0.2, at_once = 0.3, more = 1.2; // h, h, of the overlap
    const bool first = on_seam(pair[0]);
    const CloudFacetIndex f = first ? pair[0] : pair[1], g = first ? pair[1] : pair[0];
    const double above = back_to_back ? 1.0 : -1.0;
    const Vec3 n = -above * facets_.normal(g).normalized();
    const auto lacking = [&](NodeIndex i) {
      return clearance * size_[index_of(i)] -
             n.dot(cloud_.position[i] - cloud_.position[cloud_.facets[g].node[0]]);
    };
    const auto& corners = cloud_.facets[f].node;
    const bool any = std::any_of(corners.begin(), corners.end(),
                                 [&](NodeIndex i) { return within_seam_[i] && lacking(i) > 0.0; });
    const double overlap = std::min(facets_.reach(f, g, above), facets_.reach(g, f, above));
    for (const NodeIndex i : corners) {
      if (!within_seam_[i]) continue;
      const double length = std::min(any ? lacking(i) : more * overlap, at_once * size_[index_of(i)]);
      if (length > way[i].norm()) way[i] = length * n;
    }
  }

  void activate(const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs)
      for (const CloudFacetIndex f : pair)
        for (const NodeIndex i : cloud_.facets[f].node) active_[i] = 1;
  }

  /// Where faces that touch are within each other by no more than contact may leave, they part by as little,
  /// and nothing else changes.
  void part_touching() {
    constexpr int rounds = 12;
    constexpr double shallow = 0.01, clearance = 1e-6; // h
    for (int n = 0; n < rounds; ++n) {
      std::vector<Pair> pairs = voronoi::crossings(cloud_);
      std::erase_if(pairs, [&](const Pair& pair) { return !facets_.facing(pair); });
      if (pairs.empty()) return;
      const voronoi::Winding winding(cloud_);
      IndexedVector<NodeIndex, Vec3> way(cloud_.position.size(), Vec3::Zero());
      for (const Pair& pair : pairs) {
        const double h = size_[index_of(cloud_.facets[pair[0]].node[0])];
        const auto within = facets_.overlap(pair, winding);
        const double depth = std::min(within.depth, facets_.common_length(pair));
        if (depth > shallow * h) return;
        part(pair, each * (depth + clearance * h) * within.way, way);
      }
      activate(pairs);
      for (const NodeIndex i : cloud_.position.indices())
        if (!way[i].isZero(0.0)) move(i, way[i]);
      align();
    }
  }

  /// Nodes of facets that cross go, one after the other, where their facets cross least. Not where images
  /// would have to go alike.
  void untangle() {
    if (!groups_.empty()) return;
    constexpr int rounds = 24;
    for (int n = 0; n < rounds; ++n) {
      const std::vector<Pair> pairs = voronoi::crossings(cloud_);
      if (pairs.empty()) return;
      activate(pairs);
      std::vector<NodeIndex> nodes;
      for (const Pair& pair : pairs)
        for (const CloudFacetIndex f : pair)
          nodes.insert(nodes.end(), cloud_.facets[f].node.begin(), cloud_.facets[f].node.end());
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      bool any = false;
      for (const NodeIndex i : nodes) any = go_where_least_crosses(i) || any;
      if (!any) return;
    }
  }

  /// Tries steps towards the mean of its neighbours and along its normal. Whether one helps.
  bool go_where_least_crosses(NodeIndex i) {
    const Vec3 start = cloud_.position[i];
    double least = crossed_length(i);
    if (held_[i] || least == 0.0) return false;
    Vec3 outwards = Vec3::Zero();
    for (const CloudFacetIndex f : planes_.around(i)) outwards += facets_.normal(f);
    const Vec3 inwards_by_h = -size_[index_of(i)] * outwards.normalized(),
               to_mean = mean_around(i, cloud_.position) - start;
    Vec3 best = start;
    for (const Vec3& way : {Vec3(0.25 * to_mean), Vec3(0.5 * to_mean), to_mean, Vec3(0.05 * inwards_by_h),
                            Vec3(0.15 * inwards_by_h), Vec3(-0.05 * inwards_by_h)}) {
      cloud_.position[i] = start;
      move(i, way);
      if (const double length = crossed_length(i); length < least) {
        least = length;
        best = cloud_.position[i];
      }
    }
    cloud_.position[i] = best;
    return best != start;
  }

  /// m, of what the facets of a node have in common with others that they cross.
  double crossed_length(NodeIndex i) const {
    const auto around = planes_.around(i);
    const double touch = 1e-6 * size_[index_of(i)];
    double sum = 0.0;
    for (const Pair& pair : voronoi::crossings(cloud_, {around.begin(), around.end()}))
      sum += facets_.common_length(pair) + touch;
    return sum;
  }

  /// The nodes of the first facet go by `step`, those of the second by its opposite, each as far as the
  /// farthest of these.
  void part(const Pair& pair, const Vec3& step, IndexedVector<NodeIndex, Vec3>& way) const {
    for (const NodeIndex i : cloud_.facets[pair[0]].node)
      if (step.norm() > way[i].norm()) way[i] = step;
    for (const NodeIndex i : cloud_.facets[pair[1]].node)
      if (step.norm() > way[i].norm()) way[i] = -step;
  }

  /// Facets that have run into each other go apart along the normal of the one that is entered less deep.
  void push_apart(const std::vector<Pair>& pairs) {
    IndexedVector<NodeIndex, Vec3> way(cloud_.position.size(), Vec3::Zero());
    constexpr double at_once = 0.1; // h
    const voronoi::Winding winding(cloud_);
    for (const Pair& pair : pairs) {
      if (!facets_.facing(pair)) continue;
      const auto within = facets_.overlap(pair, winding);
      const double h = size_[index_of(cloud_.facets[pair[0]].node[0])];
      part(pair, std::min(each * within.depth, at_once * h) * within.way, way);
    }
    for (const NodeIndex i : cloud_.position.indices())
      if (!way[i].isZero()) move(i, way[i]);
  }

  /// Of a node of the surface, with those beside it twice.
  Vec3 mean_around(NodeIndex i, const IndexedVector<NodeIndex, Vec3>& position) const {
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const CloudFacetIndex f : planes_.around(i))
      for (const NodeIndex k : cloud_.facets[f].node)
        if (k != i) {
          sum += position[k];
          count += 1.0;
        }
    return sum / count;
  }

  void smooth() {
    constexpr double share = 0.5;
    const auto x = cloud_.position;
    for (const NodeIndex i : x.indices())
      if (active_[i]) move(i, share * (mean_around(i, x) - x[i]));
  }

  Cloud<3>& cloud_;
  CrossingFacets facets_;
  IndexedVector<NodeIndex, Vec3> before_;
  const IndexedVector<NodeIndex, char>& held_;
  const Field& size_;
  BoundaryPlanes planes_;
  const SurfaceRules& rules_;
  std::vector<std::vector<NodeIndex>> groups_; ///< of images
  IndexedVector<NodeIndex, char> active_;      ///< nodes that are smoothed
  IndexedVector<NodeIndex, char> within_seam_; ///< whether all facets of a node are of seams
};

std::vector<NodeIndex> giving(const IndexedVector<NodeIndex, char>& owing,
                              const IndexedVector<NodeIndex, char>& fixed) {
  std::vector<NodeIndex> list;
  for (const NodeIndex i : owing.indices())
    if (owing[i] && !fixed[i]) list.push_back(i);
  return list;
}

} // namespace

void unfold(Cloud<3>& cloud, const IndexedVector<NodeIndex, char>& held, const Field& size,
            const PeriodImages& images, const SurfaceRules& rules, PassReport& report) {
  const double volume = enclosed_measure(cloud);
  const IndexedVector<NodeIndex, Vec3> before = cloud.position;
  Unfolding unfolding(cloud, held, size, images, rules);
  report.folded += unfolding.run();
  IndexedVector<NodeIndex, char> owing = unfolding.active();
  if (std::count(owing.begin(), owing.end(), 1) == 0) return;
  double owed = volume - enclosed_measure(cloud);
  const double enough = 0.01 * std::abs(owed);
  std::size_t crossed = voronoi::crossings(cloud).size();
  IndexedVector<NodeIndex, char> still = held; // and what lies on another face
  constexpr int times = 24;
  for (int n = 0; n < times && std::abs(owed) > enough; ++n) {
    for (const auto* fixed : {&held, &std::as_const(still)}) {
      const WorkingSurface surface =
          swollen_by(owed, cloud, giving(owing, *fixed), *fixed, size, rules, SurfaceThresholds{}.give_back);
      Cloud<3> swollen = cloud;
      for (const NodeIndex i : cloud.position.indices()) swollen.position[i] = surface.at(i);
      const auto pairs = voronoi::crossings(swollen);
      if (pairs.size() <= crossed) {
        cloud = std::move(swollen);
        crossed = pairs.size();
        owed = volume - enclosed_measure(cloud);
        break;
      }
      for (const auto& pair : pairs)
        for (const CloudFacetIndex f : pair)
          for (const NodeIndex i : cloud.facets[f].node) still[i] = 1;
    }
    owing = with_neighbours(cloud, owing);
  }
  constexpr double most_owed = 2e-3; // of the body
  if (std::abs(owed) > most_owed * volume) cloud.position = before;
}

} // namespace cnem::adapt
