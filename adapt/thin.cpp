// Removal: nodes that crowd at the boundary or each other.
#include "adapt/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cnem::adapt {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Candidate {
  std::int32_t node;
  double badness;               ///< the smaller the worse: a length over its limit
  std::int32_t promote_to = -1; ///< becomes part of the facet that leaves this node
};

class Thinning {
public:
  Thinning(const WorkingCloud& work, const Structure& structure, const Thresholds& thresholds)
      : work_(work), structure_(structure), limit_(thresholds) {}

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

  /// Whether the boundary may go straight from the node before to the node after: nothing else may lie in or
  /// at the triangle between them.
  bool may_bypass(std::int32_t node) const {
    const std::int32_t a = work_.previous(node), c = work_.next(node);
    if (work_.next(c) == a || stays(node)) return false;
    const Vec2 &xa = at(a), &xc = at(c);
    const bool convex = cross(at(node) - xa, xc - xa) > 0.0;
    // the bottom of a slit: its mouth becomes a short facet, one of whose ends has to be able to go then
    if (!convex && (xc - xa).norm() < limit_.pair * work_.size_between(a, c) && stays(a) && stays(c))
      return false;
    for (const std::int32_t k : structure_.neighbours(node)) {
      if (k == a || k == c) continue;
      const double side = cross(xc - xa, at(k) - xa) / (xc - xa).norm();
      const double h = work_.size_between(node, k);
      if (convex && side < 0.1 * h && foot_on(at(k), xa, xc).distance < 0.3 * h) return false;
      if (convex && side <= 0.0) return false;
    }
    return true;
  }

private:
  const Vec2& at(std::int32_t i) const { return work_.cloud().position[u(i)]; }
  bool stays(std::int32_t i) const { return work_.held(i) || work_.ends_piece(i); }

  void near_edges() {
    const auto& mesh = structure_.mesh;
    for (std::size_t t = 0; t < mesh.node.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        if (mesh.facet[t][k] < 0) continue;
        const std::int32_t i = mesh.node[t][k], a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
        if (work_.on_boundary(i) || work_.held(i)) continue;
        const double h = work_.size_between(a, b);
        const Foot foot = foot_on(at(i), at(a), at(b));
        if (foot.distance >= limit_.boundary_gap * h || foot.place <= 0.0 || foot.place >= 1.0) continue;
        const double length = (at(b) - at(a)).norm();
        const bool room = std::min(foot.place, 1.0 - foot.place) * length >= limit_.clear_node * h;
        list_.push_back({i, foot.distance / (limit_.boundary_gap * h), room ? a : -1});
      }
  }

  void close_pairs() {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(work_.size()); ++i)
      for (const std::int32_t j : structure_.neighbours(i)) {
        if (j < i) continue;
        const double limit = limit_.pair * work_.size_between(i, j);
        const double squared = (at(j) - at(i)).squaredNorm();
        if (squared >= limit * limit) continue;
        const bool keep_i = work_.on_boundary(i) || work_.held(i),
                   keep_j = work_.on_boundary(j) || work_.held(j);
        if (keep_i && keep_j) continue;
        const std::int32_t goes = keep_i                                              ? j
                                  : keep_j                                            ? i
                                  : work_.node().mass[u(j)] < work_.node().mass[u(i)] ? j
                                                                                      : i;
        list_.push_back({goes, std::sqrt(squared) / limit});
      }
  }

  void boundary_nodes() {
    const double sharpest = std::cos(limit_.spike * std::numbers::pi / 180.0);
    for (std::int32_t b = 0; b < static_cast<std::int32_t>(work_.size()); ++b) {
      if (!work_.on_boundary(b) || stays(b)) continue;
      const std::int32_t a = work_.previous(b), c = work_.next(b);
      const Vec2 back = at(a) - at(b), ahead = at(c) - at(b);
      const double h = work_.node().size[u(b)], shortest = std::min(back.norm(), ahead.norm());
      const double area = 0.5 * std::abs(cross(back, ahead));
      if (shortest < limit_.short_edge * h && area < limit_.flat_area * h * h)
        list_.push_back({b, shortest / (limit_.short_edge * h)});
      else if (back.dot(ahead) > sharpest * back.norm() * ahead.norm() &&
               (cross(ahead, back) > 0.0 || std::max(back.norm(), ahead.norm()) < limit_.shallow * h))
        list_.push_back({b, 0.5});
    }
  }

  /// What coarsening leaves to remove: after all that crowds.
  void dense_nodes() {
    constexpr double after_others = 1.0;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(work_.size()); ++i) {
      if (work_.held(i)) continue;
      const double h = work_.node().size[u(i)];
      double spacing = 0.0;
      if (work_.on_boundary(i)) {
        const Vec2 back = at(work_.previous(i)) - at(i), ahead = at(work_.next(i)) - at(i);
        if (stays(i) || 0.5 * std::abs(cross(back, ahead)) > limit_.straight * h * h) continue;
        spacing = 0.5 * (back.norm() + ahead.norm());
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
  std::vector<Candidate> list_;
};

/// What the removed nodes leave behind goes to the neighbours that gained volume, in proportion.
std::vector<Parcel> inheritance(const WorkingCloud& work, const Structure& before, const Structure& after,
                                const std::vector<char>& gone, const std::vector<std::int32_t>& number) {
  std::vector<Contribution> list = contributions(work.cloud(), before.cells, gone);
  Field claimed(work.size(), 0.0);
  for (const Contribution& c : list) claimed[u(c.other)] += c.area;
  std::vector<Parcel> parcels;
  for (std::size_t first = 0; first < list.size();) {
    std::size_t last = first;
    double gained = 0.0, area = 0.0;
    std::vector<double> gain;
    for (; last < list.size() && list[last].marked == list[first].marked; ++last) {
      const std::int32_t k = list[last].other;
      const double growth = std::max(0.0, after.cells.volume[u(number[u(k)])] - before.cells.volume[u(k)]);
      gain.push_back(claimed[u(k)] > 0.0 ? growth * list[last].area / claimed[u(k)] : 0.0);
      gained += gain.back();
      area += list[last].area;
    }
    for (std::size_t e = first; e < last; ++e) {
      const double share = gained > 0.0 ? gain[e - first] / gained
                           : area > 0.0 ? list[e].area / area
                                        : 1.0 / static_cast<double>(last - first);
      if (share > 0.0) parcels.push_back({list[e].marked, list[e].other, share});
    }
    first = last;
  }
  return parcels;
}

} // namespace

namespace {

enum class Outcome { nothing_to_do, done, invalid };

Outcome thin_once(WorkingCloud& work, Structure& structure, const Thresholds& thresholds,
                  bool boundary_may_change, PassReport& report) {
  Thinning thinning(work, structure, thresholds);
  WorkingCloud changed = work;
  std::vector<char> gone(work.size(), 0), touched(work.size(), 0);
  PassReport done = report;
  for (const Candidate& candidate : thinning.candidates()) {
    const std::int32_t i = candidate.node;
    const auto around = structure.neighbours(i);
    if (touched[u(i)] ||
        std::any_of(around.begin(), around.end(), [&](std::int32_t k) { return touched[u(k)] != 0; }))
      continue;
    const bool changes_boundary = candidate.promote_to >= 0 || work.on_boundary(i);
    if (changes_boundary && !boundary_may_change) continue;
    if (candidate.promote_to >= 0) {
      const Vec2 &a = work.cloud().position[u(candidate.promote_to)],
                 &b = work.cloud().position[u(work.next(candidate.promote_to))];
      const double place = foot_on(work.cloud().position[u(i)], a, b).place;
      changed.promote(i, candidate.promote_to, a + place * (b - a));
      ++done.promoted;
    } else if (work.on_boundary(i)) {
      if (!thinning.may_bypass(i)) continue;
      changed.bypass(i);
      gone[u(i)] = 1;
      ++done.removed_boundary;
    } else {
      gone[u(i)] = 1;
      ++done.removed;
    }
    touched[u(i)] = 1;
    for (const std::int32_t k : around) touched[u(k)] = 1;
  }
  if (done.removed == report.removed && done.removed_boundary == report.removed_boundary &&
      done.promoted == report.promoted)
    return Outcome::nothing_to_do;

  WorkingCloud emptied = changed;
  const std::vector<std::int32_t> number = emptied.drop(gone);
  emptied.refresh_facets();
  std::optional<Structure> after = structure_if_valid(emptied.cloud());
  if (!after) return Outcome::invalid;
  const std::vector<Parcel> parcels = inheritance(work, structure, *after, gone, number);
  std::vector<char> orphaned = gone;
  for (const Parcel& parcel : parcels) orphaned[u(parcel.from)] = 0;
  if (std::find(orphaned.begin(), orphaned.end(), 1) != orphaned.end()) return Outcome::invalid;
  changed.move(parcels);
  changed.drop(gone);
  changed.refresh_facets();
  work = std::move(changed);
  structure = std::move(*after);
  report = done;
  return Outcome::done;
}

} // namespace

bool thin(WorkingCloud& work, Structure& structure, const Thresholds& thresholds, PassReport& report) {
  for (const bool boundary_may_change : {true, false}) {
    const Outcome outcome = thin_once(work, structure, thresholds, boundary_may_change, report);
    if (outcome != Outcome::invalid) return outcome == Outcome::done;
    ++report.undone;
  }
  return false;
}

} // namespace cnem::adapt
