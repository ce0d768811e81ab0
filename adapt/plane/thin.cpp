// Removal: nodes that crowd at the boundary or each other.
#include "adapt/plane/resample.hpp"
#include "adapt/plane/simplices.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

namespace cnem::adapt {

namespace {

struct Candidate {
  NodeIndex node;
  double badness;                         ///< the smaller the worse: a length over its limit
  NodeIndex promote_to = NodeIndex::none; ///< becomes part of the facet that leaves this node
};

class Thinning {
public:
  Thinning(const WorkingCloud& work, const Structure& structure, const Thresholds& thresholds)
      : work_(work), structure_(structure), limit_(thresholds) {
    for (const NodeIndex i : work.nodes())
      if (work.on_boundary(i)) boundary_.push_back(i);
  }

  /// Candidates, worst first.
  std::vector<Candidate> candidates() {
    near_edges();
    close_pairs();
    boundary_nodes();
    dense_nodes();
    std::sort(list_.begin(), list_.end(), [](const Candidate& a, const Candidate& b) {
      return a.badness != b.badness ? a.badness < b.badness : a.node < b.node;
    });
    return std::move(list_);
  }

  /// A node that touches the boundary from outside, moved back.
  struct Shift {
    NodeIndex node;
    Vec2 to;
  };
  /// Whether a boundary node may be passed by with its mate: faces that belong together give way to nothing.
  std::optional<std::vector<Shift>> removal(NodeIndex node) const {
    std::optional<std::vector<Shift>> shifts = bypass(node);
    const NodeIndex mate = work_.mate(node);
    if (!shifts || !exists(mate)) return shifts;
    const std::optional<std::vector<Shift>> others = bypass(mate);
    return shifts->empty() && others && others->empty() ? shifts : std::nullopt;
  }

private:
  /// What it takes for the boundary to go straight from the node before to the node after; nothing if it may
  /// not: but for what touches it and gives way a little, nothing else may lie in or at the triangle between
  /// them.
  std::optional<std::vector<Shift>> bypass(NodeIndex node) const {
    const NodeIndex a = work_.previous(node), c = work_.next(node);
    if (work_.next(c) == a || stays(node)) return std::nullopt;
    const Vec2 &xa = at(a), &xc = at(c);
    const bool convex = cross(at(node) - xa, xc - xa) > 0.0;
    // the bottom of a slit: its mouth becomes a short facet, one of whose ends has to be able to go then
    if (!convex && (xc - xa).norm() < limit_.pair * work_.size_between(a, c) && stays(a) && stays(c))
      return std::nullopt;
    std::vector<Shift> shifts;
    if (!convex)
      for (const NodeIndex k : boundary_) {
        if (k == a || k == node || k == c || lies_on(k, {a, node, c}) || !within(at(k), xa, xc, at(node)))
          continue;
        const Vec2 along = (xc - xa).normalized(), outwards(along.y(), -along.x());
        const double depth = -outwards.dot(at(k) - xa);
        if (depth > limit_.gives_way * work_.node().size[index_of(k)] || work_.held(k) || work_.has_mates(k))
          return std::nullopt;
        shifts.push_back({k, at(k) + (depth + 1e-6 * (xc - xa).norm()) * outwards});
      }
    for (const NodeIndex k : structure_.neighbours(node)) {
      if (k == a || k == c) continue;
      const double side = cross(xc - xa, at(k) - xa) / (xc - xa).norm();
      const double h = work_.size_between(node, k);
      if (convex && side < 0.1 * h && foot_on(at(k), xa, xc).distance < 0.3 * h) return std::nullopt;
      if (convex && side <= 0.0) return std::nullopt;
    }
    return shifts;
  }

  const Vec2& at(NodeIndex i) const { return work_.cloud().position[i]; }
  /// Whether a point lies in or on a triangle, corners counter-clockwise, which may be as flat as rounding.
  static bool within(const Vec2& x, const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 along = b - a;
    const double size = along.squaredNorm(), place = along.dot(x - a), top = along.dot(c - a);
    return place >= std::min(0.0, top) && place <= std::max(size, top) && cross(along, x - a) >= 0.0 &&
           cross(c - b, x - b) >= 0.0 && cross(a - c, x - c) >= 0.0;
  }
  bool stays(NodeIndex i) const { return work_.stays(i); }
  /// Whether a node is on the other face at one of these.
  bool lies_on(NodeIndex k, std::initializer_list<NodeIndex> nodes) const {
    constexpr double together = 1e-3; // mates that are farther apart have parted
    return work_.has_mates(k) && std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex i) {
             return (at(k) - at(i)).norm() < together * work_.size_between(i, k);
           });
  }

  void near_edges() {
    const auto& mesh = structure_.mesh;
    for (const SimplexIndex t : mesh.node.indices())
      for (std::size_t k = 0; k < 3; ++k) {
        if (!exists(mesh.facet[t][k])) continue;
        const NodeIndex i = mesh.node[t][k], a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
        if (work_.on_boundary(i) || work_.held(i)) continue;
        const double h = work_.size_between(a, b);
        const Foot foot = foot_on(at(i), at(a), at(b));
        if (foot.distance >= limit_.boundary_gap * h || foot.place <= 0.0 || foot.place >= 1.0) continue;
        const double length = (at(b) - at(a)).norm();
        const bool room = !exists(work_.facing(a)) &&
                          std::min(foot.place, 1.0 - foot.place) * length >= limit_.clear_node * h;
        list_.push_back({i, foot.distance / (limit_.boundary_gap * h), room ? a : NodeIndex::none});
      }
  }

  void close_pairs() {
    for (const NodeIndex i : work_.nodes())
      for (const NodeIndex j : structure_.neighbours(i)) {
        if (j < i) continue;
        const double limit = limit_.pair * work_.size_between(i, j);
        const double squared = (at(j) - at(i)).squaredNorm();
        if (squared >= limit * limit) continue;
        const bool keep_i = work_.on_boundary(i) || work_.held(i),
                   keep_j = work_.on_boundary(j) || work_.held(j);
        if (keep_i && keep_j) continue;
        const NodeIndex goes = keep_i                                                            ? j
                               : keep_j                                                          ? i
                               : work_.node().mass[index_of(j)] < work_.node().mass[index_of(i)] ? j
                                                                                                 : i;
        list_.push_back({goes, std::sqrt(squared) / limit});
      }
  }

  void boundary_nodes() {
    const double spike = std::cos(limit_.spike * std::numbers::pi / 180.0),
                 notch = std::cos(limit_.notch * std::numbers::pi / 180.0);
    for (const NodeIndex b : work_.nodes()) {
      if (!work_.on_boundary(b)) continue;
      const Turn turn = turn_at(b);
      const double h = work_.node().size[index_of(b)], shortest = std::min(turn.back, turn.ahead);
      if (structure_.cells.volume[index_of(b)] < limit_.sliver * h * h) sliver(b);
      if (stays(b)) continue;
      if (shortest < limit_.short_edge * h && turn.area < limit_.flat_area * h * h)
        list_.push_back({b, shortest / (limit_.short_edge * h)});
      else if (turn.reflex ? turn.cosine > notch && std::max(turn.back, turn.ahead) < limit_.shallow * h
                           : turn.cosine > spike || (work_.is_debris(b) && shortest > debris_flown * h))
        list_.push_back({b, 0.5});
    }
  }

  /// The boundary at one of its nodes.
  struct Turn {
    double back, ahead; ///< m, to the nodes before and after
    double cosine;      ///< of the angle between these
    double area;        ///< m², of the triangle with them
    bool reflex;
  };
  Turn turn_at(NodeIndex b) const {
    const Vec2 back = at(work_.previous(b)) - at(b), ahead = at(work_.next(b)) - at(b);
    const double lengths = back.norm() * ahead.norm(), twice = cross(ahead, back);
    return {back.norm(), ahead.norm(), back.dot(ahead) / lengths, 0.5 * std::abs(twice), twice < 0.0};
  }

  /// A tip too small for the step: it goes, or the bottom of the notch beside it where that changes less.
  void sliver(NodeIndex tip) {
    NodeIndex goes = NodeIndex::none;
    for (const NodeIndex i : {tip, work_.previous(tip), work_.next(tip)})
      if (!stays(i) && (i == tip || turn_at(i).reflex) &&
          (!exists(goes) || turn_at(i).area < turn_at(goes).area))
        goes = i;
    if (exists(goes)) list_.push_back({goes, 0.5});
  }

  /// What coarsening leaves to remove: after all that crowds.
  void dense_nodes() {
    constexpr double after_others = 1.0;
    for (const NodeIndex i : work_.nodes()) {
      if (work_.held(i)) continue;
      const double h = work_.node().size[index_of(i)];
      double spacing = 0.0;
      if (work_.on_boundary(i)) {
        const Turn turn = turn_at(i);
        if (stays(i) || turn.area > limit_.straight * h * h) continue;
        spacing = 0.5 * (turn.back + turn.ahead);
      } else {
        spacing = spacing_at(work_.cloud(), structure_, i);
      }
      const double badness = spacing / (limit_.dense * h);
      if (badness < 1.0) list_.push_back({i, after_others + badness});
    }
  }

  const WorkingCloud& work_;
  const Structure& structure_;
  const Thresholds& limit_;
  std::vector<NodeIndex> boundary_;
  std::vector<Candidate> list_;
};

/// What the removed nodes leave behind goes to the neighbours that gained volume, in proportion.
std::vector<Parcel> inheritance(const WorkingCloud& work, const Structure& before, const Structure& after,
                                const IndexedVector<NodeIndex, char>& gone,
                                const IndexedVector<NodeIndex, NodeIndex>& number) {
  std::vector<Contribution> list = contributions(work.cloud(), before, gone);
  Field claimed(work.size(), 0.0);
  for (const Contribution& c : list) claimed[index_of(c.other)] += c.volume;
  std::vector<Parcel> parcels;
  for (std::size_t first = 0; first < list.size();) {
    std::size_t last = first;
    double gained = 0.0, volume = 0.0;
    std::vector<double> gain;
    for (; last < list.size() && list[last].marked == list[first].marked; ++last) {
      const NodeIndex k = list[last].other;
      const double growth = std::max(0.0, after.volume(number[k]) - before.volume(k));
      gain.push_back(claimed[index_of(k)] > 0.0 ? growth * list[last].volume / claimed[index_of(k)] : 0.0);
      gained += gain.back();
      volume += list[last].volume;
    }
    for (std::size_t e = first; e < last; ++e) {
      const double share = gained > 0.0   ? gain[e - first] / gained
                           : volume > 0.0 ? list[e].volume / volume
                                          : 1.0 / static_cast<double>(last - first);
      if (share > 0.0) parcels.push_back({list[e].marked, list[e].other, share});
    }
    first = last;
  }
  return parcels;
}

} // namespace

bool thin(WorkingCloud& work, Structure& structure, const Thresholds& thresholds, PassReport& report) {
  Thinning thinning(work, structure, thresholds);
  const std::vector<Candidate> candidates = thinning.candidates();
  if (candidates.empty()) return false;
  WorkingCloud changed = work;
  Simplices simplices(structure);
  IndexedVector<NodeIndex, char> gone(work.size(), 0), touched(work.size(), 0);
  PassReport done = report;
  for (const Candidate& candidate : candidates) {
    const NodeIndex i = candidate.node;
    const NodeIndex mate = work.mate(i);
    const auto busy = [&](NodeIndex node) {
      const auto around = structure.neighbours(node);
      return touched[node] ||
             std::any_of(around.begin(), around.end(), [&](NodeIndex k) { return touched[k] != 0; });
    };
    if (busy(i) || (exists(mate) && busy(mate))) continue;
    if (exists(candidate.promote_to)) {
      const Vec2 &a = work.cloud().position[candidate.promote_to],
                 &b = work.cloud().position[work.next(candidate.promote_to)];
      const double place = foot_on(work.cloud().position[i], a, b).place;
      changed.promote(i, candidate.promote_to, a + place * (b - a));
      simplices.promote(candidate.promote_to);
      ++done.promoted;
    } else if (work.on_boundary(i)) {
      const auto shifts = thinning.removal(i);
      if (!shifts || changed.stays(i) || std::any_of(shifts->begin(), shifts->end(), [&](const auto& shift) {
            return touched[shift.node] != 0;
          }))
        continue;
      for (const auto& shift : *shifts) {
        changed.place(shift.node, shift.to);
        touched[shift.node] = 1;
      }
      changed.bypass(i);
      gone[i] = 1;
      ++done.removed_boundary;
      if (exists(mate)) {
        gone[mate] = 1;
        ++done.removed_boundary;
      }
    } else {
      gone[i] = 1;
      ++done.removed;
    }
    for (const NodeIndex node : {i, mate}) {
      if (!exists(node)) continue;
      if (gone[node]) simplices.remove(changed, node);
      touched[node] = 1;
      for (const NodeIndex k : structure.neighbours(node)) touched[k] = 1;
    }
  }
  if (done.removed == report.removed && done.removed_boundary == report.removed_boundary &&
      done.promoted == report.promoted)
    return false;

  WorkingCloud emptied = changed;
  const IndexedVector<NodeIndex, NodeIndex> number = emptied.drop(gone);
  emptied.refresh_facets();
  simplices.hand_to(emptied, number);
  std::optional<Structure> after = structure_if_valid(emptied.cloud(), structure.space);
  std::vector<Parcel> parcels;
  IndexedVector<NodeIndex, char> orphaned = gone;
  if (after) parcels = inheritance(work, structure, *after, gone, number);
  for (const Parcel& parcel : parcels) orphaned[parcel.from] = 0;
  if (!after || std::find(orphaned.begin(), orphaned.end(), 1) != orphaned.end()) {
    ++report.undone;
    return false;
  }
  changed.move(parcels);
  changed.drop(gone);
  changed.refresh_facets();
  work = std::move(changed);
  structure = std::move(*after);
  report = done;
  return true;
}

} // namespace cnem::adapt
