// Separation: where broken matter goes through the body, the cloud is opened along Delaunay edges.
#include "adapt/plane/broken_matter.hpp"
#include "adapt/plane/cut.hpp"
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

namespace cnem::adapt {

namespace {

class Cutting : BrokenMatter {
public:
  Cutting(const WorkingCloud& work, const Structure& structure, const SplitRules& rules)
      : BrokenMatter(work, structure, rules), loops_(work) {
    number_chains();
  }

  /// The cut of least cost, the integral of 1/broken along it, in pieces from mate to mate. Empty when there
  /// is none.
  std::vector<Path> best() const {
    Path best;
    double least = std::numeric_limits<double>::infinity();
    for (const NodeIndex from : work_.nodes()) {
      if (chain_[from] < 0 || chain_[from] == longest_) continue; // from its other end then
      const auto [path, cost] = from_node(from, least);
      if (cost < least) {
        least = cost;
        best = path;
      }
    }
    std::vector<Path> pieces;
    for (const NodeIndex i : best) {
      if (pieces.empty() || (work_.on_boundary(i) && work_.mate(i) == pieces.back().back()))
        pieces.emplace_back();
      pieces.back().push_back(i);
    }
    return pieces;
  }

private:
  bool may_end(NodeIndex i) const { return work_.on_boundary(i) && !work_.has_mates(i) && broken(i); }
  /// Whether a cut can go on at the mate of a boundary node.
  bool crosses(NodeIndex i) const { return exists(work_.mate(i)) && broken(work_.mate(i)); }

  /// Broken boundary nodes that follow each other make a chain: a cut leads from one to another.
  void number_chains() {
    chain_.assign(work_.size(), -1);
    std::vector<std::int32_t> length;
    for (const NodeIndex i : work_.nodes()) {
      if (!may_end(i) || chain_[i] >= 0) continue;
      NodeIndex begin = i;
      while (may_end(work_.previous(begin)) && work_.previous(begin) != i) begin = work_.previous(begin);
      length.push_back(0);
      for (NodeIndex k = begin; may_end(k) && chain_[k] < 0; k = work_.next(k)) {
        chain_[k] = as<std::int32_t>(length.size()) - 1;
        ++length.back();
      }
    }
    longest_ = as<std::int32_t>(std::max_element(length.begin(), length.end()) - length.begin());
  }

  /// Cuts run inside, not in the layer of nodes beside the boundary.
  double detour(NodeIndex i) const {
    constexpr double beside = 4.0;
    const auto around = structure_.neighbours(i);
    return std::any_of(around.begin(), around.end(), [&](NodeIndex k) { return work_.on_boundary(k); })
               ? beside
               : 1.0;
  }

  /// What a cut costs that leaves the lip of a crack elsewhere than at its tip, m.
  double lip(NodeIndex i) const {
    if (!rules_.cracks || work_.is_tip(i)) return 0.0;
    return face(i) ? rules_.from_lip * work_.node().size[index_of(i)] / broken_[index_of(i)] : 0.0;
  }

  /// The cheapest cut from a boundary node to another chain, and its cost (Dijkstra's algorithm).
  std::pair<Path, double> from_node(NodeIndex from, double limit) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    Field cost(work_.size(), far), length(work_.size(), 0.0);
    IndexedVector<NodeIndex, NodeIndex> came(work_.size(), NodeIndex::none);
    using Entry = std::pair<double, NodeIndex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    cost[index_of(from)] = lip(from);
    front.emplace(cost[index_of(from)], from);
    while (!front.empty()) {
      const auto [known, i] = front.top();
      front.pop();
      if (known > cost[index_of(i)]) continue;
      if (known >= limit) break;
      const bool goes_on = i == from || came[i] == work_.mate(i); // from the boundary inwards
      if (work_.on_boundary(i) && !goes_on && work_.has_mates(i)) {
        const NodeIndex mate = work_.mate(i);
        if (known >= cost[index_of(mate)]) continue;
        cost[index_of(mate)] = known;
        length[index_of(mate)] = length[index_of(i)];
        came[mate] = i;
        front.emplace(known, mate);
        continue;
      }
      if (work_.on_boundary(i) && !goes_on) {
        if (!loops_.parts(from, i, rules_.part * length[index_of(i)], rules_.least_loop)) continue;
        Path path;
        for (NodeIndex k = i; exists(k); k = came[k]) path.push_back(k);
        std::reverse(path.begin(), path.end());
        return {path, known};
      }
      for (const NodeIndex k : structure_.neighbours(i)) {
        if (!broken(k)) continue;
        if (work_.on_boundary(i) && (work_.on_boundary(k) || shaves(work_, i, k, rules_))) continue;
        if (work_.on_boundary(k) &&
            (!(crosses(k) || may_end(k)) || chain_[k] == chain_[from] || shaves(work_, k, i, rules_)))
          continue;
        const double reached = known + (work_.on_boundary(k) ? lip(k) : 0.0) +
                               cost_of(i, k, work_.on_boundary(k) ? 1.0 : detour(k));
        if (reached >= cost[index_of(k)]) continue;
        cost[index_of(k)] = reached;
        length[index_of(k)] = length[index_of(i)] + (at(k) - at(i)).norm();
        came[k] = i;
        front.emplace(reached, k);
      }
    }
    return {{}, far};
  }

  BoundaryLoops loops_;
  IndexedVector<NodeIndex, std::int32_t> chain_; ///< −1: none
  std::int32_t longest_ = -1;
};

} // namespace

void split(WorkingCloud& work, Structure& structure, const SplitRules& rules, PassReport& report) {
  constexpr int most = 8; // cuts in one pass
  for (int k = 0; k < most; ++k) {
    const std::vector<Path> paths = Cutting(work, structure, rules).best();
    if (paths.empty()) return;
    if (!open_cut(work, structure, paths, rules, report)) return;
    ++report.cuts;
  }
}

} // namespace cnem::adapt
