// What has to be put right before a cloud can be triangulated at all.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/plane/edge_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace cnem::adapt {

namespace {

/// Whether the segments ab and cd cross.
bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  return c_side * d_side < 0.0 && a_side * b_side < 0.0;
}

constexpr int longest_fold = 8; ///< nodes

class Mending {
public:
  explicit Mending(const WorkingCloud& work) : work_(work) {}

  bool may_go(NodeIndex i) const {
    const auto in_a_triangle = [&](NodeIndex k) { return work_.next(work_.next(k)) == work_.previous(k); };
    const NodeIndex mate = work_.mate(i);
    return !work_.stays(i) && !in_a_triangle(i) && !(exists(mate) && in_a_triangle(mate));
  }

  /// The boundary comes back along itself: the body has an angle below 3 degrees there. The tip of an open
  /// crack, round which the body lies, is none.
  bool turns_back(NodeIndex i) const {
    constexpr double cosine = 0.9986, open = -1e-6;
    const Vec2 back = at(work_.previous(i)) - at(i), ahead = at(work_.next(i)) - at(i);
    const double lengths = back.norm() * ahead.norm();
    return back.dot(ahead) > cosine * lengths && cross(ahead, back) > open * lengths;
  }

  /// How many nodes, from this one on, make a loop: the facets before and behind them cross. 0: none.
  int loop(NodeIndex i) const {
    const NodeIndex before = work_.previous(i);
    NodeIndex last = work_.next(i);
    for (int nodes = 2; nodes <= longest_fold; ++nodes, last = work_.next(last)) {
      const NodeIndex behind = work_.next(last);
      if (last == before || behind == before) return 0;
      if (crosses(at(before), at(i), at(last), at(behind)))
        return nodes == 2 || longer(behind, before, nodes) ? nodes : 0;
    }
    return 0;
  }

private:
  const Vec2& at(NodeIndex i) const { return work_.cloud().position[i]; }
  /// Whether the boundary has more nodes than that from one node to another: what is cut off is the smaller
  /// part.
  bool longer(NodeIndex from, NodeIndex to, int nodes) const {
    for (; nodes > 0; --nodes, from = work_.next(from))
      if (from == to) return false;
    return true;
  }
  const WorkingCloud& work_;
};

} // namespace

void mend_boundary(WorkingCloud& work, PassReport& report) {
  const Mending mending(work);
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  bool any = false;
  const auto bypass = [&](NodeIndex i) {
    for (const NodeIndex k : {i, work.mate(i)}) {
      if (!exists(k)) continue;
      const Vec2& x = work.cloud().position[k];
      const NodeIndex a = work.previous(k), c = work.next(k);
      const bool to_a = (work.cloud().position[a] - x).norm() < (work.cloud().position[c] - x).norm();
      work.move_now(k, to_a ? a : c, 1.0);
      gone[k] = 1;
      ++report.folded;
    }
    work.bypass(i);
    any = true;
  };
  for (int round = 0; round < longest_fold; ++round) {
    const int before = report.folded;
    for (const NodeIndex i : work.nodes()) {
      if (!work.on_boundary(i)) continue;
      if (mending.turns_back(i)) {
        if (mending.may_go(i)) bypass(i);
      } else if (const int nodes = mending.loop(i); nodes == 2) {
        const NodeIndex next = work.next(i);
        if (mending.may_go(i))
          bypass(i);
        else if (mending.may_go(next))
          bypass(next);
      } else if (nodes > 2) { // a film that has been drawn through itself
        NodeIndex k = i;
        for (int n = 0; n < nodes; ++n) {
          const NodeIndex next = work.next(k);
          if (mending.may_go(k)) bypass(k);
          k = next;
        }
      }
    }
    if (report.folded == before) break;
  }
  if (!any) return;
  work.drop(gone);
  work.refresh_facets();
}

namespace {

/// Marked interior nodes give their mass to the ends of the nearest edge of their own part.
bool give_to_boundary(WorkingCloud& work, const IndexedVector<NodeIndex, char>& gone, PassReport& report) {
  const Cloud<2>& cloud = work.cloud();
  std::vector<Parcel> parcels;
  for (const NodeIndex i : work.nodes()) {
    if (!gone[i]) continue;
    double best = std::numeric_limits<double>::max();
    Parcel to_start{i, NodeIndex::none, 1.0}, to_end = to_start;
    for (const Facet<2>& facet : cloud.facets) {
      const auto [a, b] = facet.node;
      if (!work.may_mix(i, a) || !cloud.one_body(i, a)) continue;
      const Foot foot = foot_on(cloud.position[i], cloud.position[a], cloud.position[b]);
      if (foot.distance >= best) continue;
      best = foot.distance;
      const double place = std::clamp(foot.place, 0.0, 1.0);
      to_start.to = a;
      to_start.fraction = 1.0 - place;
      to_end.to = b;
      to_end.fraction = place;
    }
    for (const Parcel& parcel : {to_start, to_end})
      if (parcel.fraction > 0.0) parcels.push_back(parcel);
    ++report.outside;
  }
  if (parcels.empty()) return false;
  work.move(parcels);
  work.drop(gone);
  work.refresh_facets();
  return true;
}

} // namespace

void drop_outside(WorkingCloud& work, PassReport& report) {
  const Cloud<2>& cloud = work.cloud();
  std::map<std::int32_t, voronoi::EdgeTree> trees; // of the boundary of each body
  const auto body_of = [&](NodeIndex i) { return cloud.body.empty() ? 0 : cloud.body[i]; };
  for (const Facet<2>& facet : cloud.facets)
    if (const std::int32_t body = body_of(facet.node[0]); !trees.contains(body)) {
      Cloud<2> own = cloud;
      std::erase_if(own.facets, [&](const Facet<2>& f) { return body_of(f.node[0]) != body; });
      trees.emplace(body, own);
    }
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  for_each_block(work.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (work.on_boundary(as<NodeIndex>(i))) continue;
      const Vec2& x = cloud.position[i];
      const voronoi::EdgeTree& tree = trees.at(body_of(as<NodeIndex>(i)));
      const double touching = 1e-6 * work.node().size[i];
      gone[i] = tree.distance(x, touching) < touching || !tree.inside(x);
    }
  });
  give_to_boundary(work, gone, report);
}

void drop_strayed(WorkingCloud& work, Structure& structure, PassReport& report) {
  if (work.node().part.empty()) return;
  // from the boundary inwards: which part the neighbours of a node are of
  IndexedVector<NodeIndex, NodeIndex> from(work.size(), NodeIndex::none);
  std::vector<NodeIndex> front;
  for (const NodeIndex i : work.nodes())
    if (work.on_boundary(i)) {
      from[i] = i;
      front.push_back(i);
    }
  for (std::size_t k = 0; k < front.size(); ++k)
    for (const NodeIndex next : structure.neighbours(front[k]))
      if (!exists(from[next])) {
        from[next] = from[front[k]];
        front.push_back(next);
      }
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  for (const NodeIndex i : front) gone[i] = !work.may_mix(i, from[i]) || !work.cloud().one_body(i, from[i]);
  if (give_to_boundary(work, gone, report)) structure = build_structure(work.cloud(), structure.space);
}

} // namespace cnem::adapt
