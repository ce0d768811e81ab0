// What has to be put right before a cloud can be triangulated at all.
#include "adapt/resample.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/edge_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
    const NodeIndex a = work_.previous(i), c = work_.next(i);
    return !work_.held(i) && !work_.ends_piece(i) && work_.next(c) != a;
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
    const Vec2& x = work.cloud().position[i];
    const NodeIndex a = work.previous(i), c = work.next(i);
    const bool to_a = (work.cloud().position[a] - x).norm() < (work.cloud().position[c] - x).norm();
    work.move_now(i, to_a ? a : c, 1.0);
    work.bypass(i);
    gone[i] = 1;
    any = true;
    ++report.folded;
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

void drop_outside(WorkingCloud& work, PassReport& report) {
  const Cloud<2>& cloud = work.cloud();
  const voronoi::EdgeTree tree(cloud);
  IndexedVector<NodeIndex, char> gone(work.size(), 0);
  for_each_block(work.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (work.on_boundary(as<NodeIndex>(i))) continue;
      const Vec2& x = cloud.position[i];
      const double touching = 1e-6 * work.node().size[i];
      gone[i] = tree.distance(x, touching) < touching || !tree.inside(x);
    }
  });
  std::vector<Parcel> parcels;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) continue;
    double best = std::numeric_limits<double>::max();
    Parcel to_start{as<NodeIndex>(i), NodeIndex::none, 1.0}, to_end = to_start;
    for (const Facet<2>& facet : cloud.facets) {
      const auto [a, b] = facet.node;
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
  if (parcels.empty()) return;
  work.move(parcels);
  work.drop(gone);
  work.refresh_facets();
}

} // namespace cnem::adapt
