// Cracks: where matter is broken but not through the body, the cloud is opened from the boundary to a tip.
#include "adapt/plane/broken_matter.hpp"
#include "adapt/plane/cut.hpp"
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace cnem::adapt {

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

class Cracking : BrokenMatter {
public:
  Cracking(const WorkingCloud& work, const Structure& structure, const SplitRules& rules)
      : BrokenMatter(work, structure, rules), beside_(work.size(), 0) {
    for (const NodeIndex i : work.nodes()) {
      if (!work.on_boundary(i)) continue;
      if (face(i)) faces_.push_back(i);
      for (const NodeIndex k : structure.neighbours(i)) beside_[k] = 1;
    }
  }

  /// From the tip of a crack through what is broken ahead of it; empty where that is too short.
  Path advance(NodeIndex tip) const {
    if (!broken(tip) || work_.has_mates(tip) || !face(tip) || !work_.is_tip(tip)) return {};
    const Vec2 ahead = direction(tip);
    const auto in_front = [&](NodeIndex i) {
      const Vec2 r = at(i) - at(tip);
      return r.dot(ahead) > cone * r.norm();
    };
    const std::array<NodeIndex, 3> own{tip, work_.previous(tip), work_.next(tip)};
    const auto clear = [&](NodeIndex i) { return !beside_[i] || beside_only(i, own); };
    const Search search = spread({tip}, [&](NodeIndex i) { return in_front(i) && clear(i); });
    NodeIndex end = NodeIndex::none;
    double longest = rules_.advance;
    for (const NodeIndex i : work_.nodes()) {
      if (search.cost[index_of(i)] == unreached || i == tip) continue;
      const double chord = (at(i) - at(tip)).norm();
      if (chord / work_.size_between(i, tip) < longest || search.length[index_of(i)] > crooked * chord)
        continue;
      longest = chord / work_.size_between(i, tip);
      end = i;
    }
    return search.path_to(end);
  }

  /// From the boundary to the deepest node of a connected set of broken nodes: the longest of these ways that
  /// is long and slender enough; empty where there is none.
  Path begin() const {
    std::vector<NodeIndex> sources;
    for (const NodeIndex i : work_.nodes())
      if (work_.on_boundary(i)) sources.push_back(i);
    const Search depth = spread(sources, [](NodeIndex) { return true; });
    IndexedVector<NodeIndex, char> seen(work_.size(), 0);
    Path best;
    double longest = 0.0;
    for (const NodeIndex start : work_.nodes()) {
      if (seen[start] || !broken(start) || work_.on_boundary(start)) continue;
      std::vector<NodeIndex> set{start};
      seen[start] = 1;
      double area = 0.0;
      NodeIndex deepest = NodeIndex::none;
      for (std::size_t k = 0; k < set.size(); ++k) {
        const NodeIndex i = set[k];
        area += structure_.cells.volume[index_of(i)];
        if (!beside_[i] && depth.length[index_of(i)] < unreached &&
            (!exists(deepest) || depth.length[index_of(i)] > depth.length[index_of(deepest)]))
          deepest = i;
        for (const NodeIndex next : structure_.neighbours(i))
          if (!seen[next] && broken(next) && !work_.on_boundary(next)) {
            seen[next] = 1;
            set.push_back(next);
          }
      }
      if (!exists(deepest) || set.size() < 3) continue;
      Path path = to_mouth(deepest);
      if (path.empty()) continue;
      const double chord = (at(path.front()) - at(path.back())).norm();
      if (chord < rules_.first * work_.size_between(path.front(), path.back()) ||
          chord * chord < rules_.slender * area || chord <= longest)
        continue;
      longest = chord;
      best = std::move(path);
    }
    return best;
  }

private:
  static constexpr double cone = 0.0;    ///< cosine of the angle by which a crack may turn at its tip
  static constexpr double crooked = 1.4; ///< longest path over its chord

  struct Search {
    Field cost, length;
    IndexedVector<NodeIndex, NodeIndex> came;
    Path path_to(NodeIndex end) const {
      Path path;
      for (NodeIndex k = end; exists(k); k = came[k]) path.push_back(k);
      std::reverse(path.begin(), path.end());
      return path;
    }
  };

  /// All boundary nodes beside i are among `own`.
  bool beside_only(NodeIndex i, const std::array<NodeIndex, 3>& own) const {
    const auto around = structure_.neighbours(i);
    return std::all_of(around.begin(), around.end(), [&](NodeIndex k) {
      return !work_.on_boundary(k) || std::find(own.begin(), own.end(), k) != own.end();
    });
  }

  /// Where a crack goes at its tip: away from the middle of its last two facets on either face.
  Vec2 direction(NodeIndex tip) const {
    const NodeIndex a = work_.previous(tip), b = work_.next(tip);
    Vec2 behind = 0.5 * (at(a) + at(b));
    if (face(a) && face(b)) behind = 0.5 * (at(work_.previous(a)) + at(work_.next(b)));
    return (at(tip) - behind).normalized();
  }

  /// Where a new crack may begin.
  bool may_begin(NodeIndex i) const {
    if (!work_.on_boundary(i) || work_.has_mates(i) || !broken(i) || face(i)) return false;
    const double apart = rules_.apart * work_.node().size[index_of(i)];
    return std::none_of(faces_.begin(), faces_.end(),
                        [&](NodeIndex k) { return (at(k) - at(i)).squaredNorm() < apart * apart; });
  }

  /// The cheapest way from a deep node to where a crack may begin, from there on; empty when it is crooked.
  Path to_mouth(NodeIndex deepest) const {
    const Search search = spread({deepest}, [](NodeIndex) { return true; });
    NodeIndex mouth = NodeIndex::none, inside = mouth;
    double least = unreached;
    for (const NodeIndex i : work_.nodes()) {
      if (!may_begin(i)) continue;
      for (const NodeIndex k : structure_.neighbours(i)) {
        if (work_.on_boundary(k) || search.cost[index_of(k)] == unreached || shaves(work_, i, k, rules_))
          continue;
        const double cost = search.cost[index_of(k)] + cost_of(i, k);
        if (cost >= least) continue;
        least = cost;
        mouth = i;
        inside = k;
      }
    }
    if (!exists(mouth)) return {};
    Path path = search.path_to(inside);
    path.push_back(mouth);
    std::reverse(path.begin(), path.end());
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) length += (at(path[k + 1]) - at(path[k])).norm();
    if (length > crooked * (at(path.back()) - at(mouth)).norm()) return {};
    for (std::size_t k = 2; k < path.size(); ++k)
      if (beside_[path[k]]) return {};
    return path;
  }

  /// Dijkstra's algorithm over broken interior nodes that `may` be entered.
  template<class May> Search spread(const std::vector<NodeIndex>& from, const May& may) const {
    Search search{Field(work_.size(), unreached), Field(work_.size(), unreached),
                  IndexedVector<NodeIndex, NodeIndex>(work_.size(), NodeIndex::none)};
    using Entry = std::pair<double, NodeIndex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (const NodeIndex i : from) {
      search.cost[index_of(i)] = search.length[index_of(i)] = 0.0;
      front.emplace(0.0, i);
    }
    while (!front.empty()) {
      const auto [known, i] = front.top();
      front.pop();
      if (known > search.cost[index_of(i)]) continue;
      for (const NodeIndex k : structure_.neighbours(i)) {
        if (!broken(k) || work_.on_boundary(k) || !may(k)) continue;
        const double reached = known + cost_of(i, k);
        if (reached >= search.cost[index_of(k)]) continue;
        search.cost[index_of(k)] = reached;
        search.length[index_of(k)] = search.length[index_of(i)] + (at(k) - at(i)).norm();
        search.came[k] = i;
        front.emplace(reached, k);
      }
    }
    return search;
  }

  IndexedVector<NodeIndex, char> beside_; ///< has a neighbour on the boundary
  std::vector<NodeIndex> faces_;          ///< nodes of faces that separation has made
};

} // namespace

void open_cracks(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report) {
  std::vector<NodeIndex> tips;
  for (const NodeIndex i : work.nodes())
    if (work.on_boundary(i) && work.is_tip(i)) tips.push_back(i);
  for (const NodeIndex tip : tips)
    if (const Path path = Cracking(work, structure, rules).advance(tip);
        !path.empty() && open_cut(work, structure, std::array{path}, rules, report))
      ++report.advances;
  constexpr int most = 8; // new cracks in one pass
  for (int k = 0; k < most; ++k) {
    const Path path = Cracking(work, structure, rules).begin();
    if (path.empty() || !open_cut(work, structure, std::array{path}, rules, report)) return;
    ++report.cracks;
  }
}

} // namespace cnem::adapt
