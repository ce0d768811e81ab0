// The least surface through broken matter.
#include "adapt/space/least_cut.hpp"
#include "adapt/space/separate.hpp"
#include "core/disjoint_sets.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace cnem::adapt {
namespace {

using voronoi::face_of_tetrahedron;
using voronoi::Tetrahedra;
using Parts = IndexedVector<SimplexIndex, std::int32_t>;

/// A face between two blocks that may be opened.
struct Passage {
  std::int32_t from, to;
  double weight;
};

class Cut {
public:
  Cut(const Cloud<3>& cloud, const Tetrahedra& mesh, const Field& broken, int least_part)
      : cloud_(cloud), mesh_(mesh), broken_(broken), least_part_(least_part) {}

  Parts parts() {
    find_blocks();
    find_seeds();
    part_of_block_.assign(blocks_, 0);
    std::int32_t last = 0;
    for (const std::vector<std::int32_t>& seeds : seeds_) // of one component
      for (std::size_t s = 1; s < seeds.size(); ++s) isolate(seeds, s, ++last);
    if (last == 0) return {};
    if (!without_branches()) return {};
    return numbered();
  }

private:
  bool may_open(SimplexIndex t, std::size_t k) const {
    if (!exists(mesh_.neighbour[t][k])) return false;
    for (const std::size_t c : face_of_tetrahedron[k])
      if (!(broken_[index_of(mesh_.node[t][c])] >= 1.0)) return false;
    return true;
  }

  double weight(SimplexIndex t, std::size_t k) const {
    std::array<Vec3, 3> x;
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const NodeIndex i = mesh_.node[t][face_of_tetrahedron[k][c]];
      x[c] = cloud_.position[i];
      sum += broken_[index_of(i)];
    }
    return 3.0 * area_normal<3>(x).norm() / sum;
  }

  /// Blocks: tetrahedra that no cut can divide. Components: what hangs together.
  void find_blocks() {
    const std::size_t n = mesh_.node.size();
    DisjointSets whole(n), apart(n);
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 4; ++k) {
        const SimplexIndex next = mesh_.neighbour[t][k];
        if (!exists(next) || next < t) continue;
        whole.join(index_of(t), index_of(next));
        if (!may_open(t, k)) apart.join(index_of(t), index_of(next));
      }
    block_.assign(n, -1);
    for (std::size_t t = 0; t < n; ++t) {
      if (apart.first(t) == t) {
        block_[t] = static_cast<std::int32_t>(blocks_++);
        component_.push_back(whole.first(t));
      }
      block_[t] = block_[apart.first(t)];
    }
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 4; ++k) {
        const SimplexIndex next = mesh_.neighbour[t][k];
        if (exists(next) && t < next && block_[t] != block_[next])
          passages_.push_back({block_[t], block_[next], weight(t, k)});
      }
  }

  /// Blocks with enough nodes to be a part, the largest of each component first.
  void find_seeds() {
    std::vector<std::pair<std::int32_t, NodeIndex>> pairs;
    pairs.reserve(4 * mesh_.node.size());
    for (const SimplexIndex t : mesh_.node.indices())
      for (const NodeIndex i : mesh_.node[t]) pairs.emplace_back(block_[t], i);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<std::size_t> nodes(blocks_, 0);
    for (const auto& pair : pairs) ++nodes[index_of(pair.first)];
    std::vector<std::int32_t> large;
    for (std::size_t b = 0; b < blocks_; ++b)
      if (nodes[b] >= index_of(least_part_)) large.push_back(static_cast<std::int32_t>(b));
    std::stable_sort(large.begin(), large.end(), [&](std::int32_t a, std::int32_t b) {
      const auto ca = component_[index_of(a)], cb = component_[index_of(b)];
      return ca != cb ? ca < cb : nodes[index_of(a)] > nodes[index_of(b)];
    });
    is_seed_.assign(blocks_, 0);
    for (std::size_t n = 0; n < large.size(); ++n) {
      is_seed_[index_of(large[n])] = 1;
      if (n == 0 || component_[index_of(large[n])] != component_[index_of(large[n - 1])])
        seeds_.emplace_back();
      seeds_.back().push_back(large[n]);
    }
  }

  /// Gives seed s and what the least cut leaves it, among the blocks that are in no part yet, a number.
  void isolate(const std::vector<std::int32_t>& seeds, std::size_t s, std::int32_t number) {
    std::vector<std::size_t> vertex(blocks_); // the one after the blocks stands for the other seeds
    std::iota(vertex.begin(), vertex.end(), std::size_t{0});
    for (const std::int32_t other : seeds)
      if (other != seeds[s]) vertex[index_of(other)] = blocks_;
    std::vector<GraphEdge> edges;
    for (const Passage& passage : passages_) {
      if (part_of_block_[index_of(passage.from)] != 0 || part_of_block_[index_of(passage.to)] != 0) continue;
      const std::size_t a = vertex[index_of(passage.from)], b = vertex[index_of(passage.to)];
      if (a == b) continue;
      edges.push_back({a, b, passage.weight});
    }
    const std::vector<char> with_source = side_of_least_cut(blocks_ + 1, edges, index_of(seeds[s]), blocks_);
    for (std::size_t b = 0; b < blocks_; ++b)
      if (part_of_block_[b] == 0 && component_[b] == component_[index_of(seeds[s])] &&
          with_source[vertex[b]] != 0)
        part_of_block_[b] = number;
  }

  std::int32_t part(SimplexIndex t) const { return part_of_block_[index_of(block_[t])]; }

  /// Where a part comes to an edge from two sides the smaller one goes to another part; false where it
  /// cannot.
  bool without_branches() {
    constexpr int rounds = 50;
    for (int round = 0; round < rounds; ++round) {
      const Joined joined = join_at_edges();
      if (joined != Joined::some) return joined == Joined::none_needed;
    }
    return false;
  }

  enum class Joined { none_needed, some, impossible };

  /// A tetrahedron at an edge.
  struct AtEdge {
    std::array<NodeIndex, 2> edge;
    SimplexIndex tetrahedron;
  };

  Joined join_at_edges() {
    std::vector<AtEdge> list;
    IndexedVector<NodeIndex, char> on_cut(cloud_.position.size(), 0);
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 4; ++k)
        if (exists(mesh_.neighbour[t][k]) && part(mesh_.neighbour[t][k]) != part(t))
          for (const std::size_t c : face_of_tetrahedron[k]) on_cut[mesh_.node[t][c]] = 1;
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) {
          const NodeIndex i = mesh_.node[t][a], k = mesh_.node[t][b];
          if (on_cut[i] && on_cut[k]) list.push_back({{std::min(i, k), std::max(i, k)}, t});
        }
    std::sort(list.begin(), list.end(), [](const AtEdge& a, const AtEdge& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.tetrahedron < b.tetrahedron;
    });
    Joined all = Joined::none_needed;
    for (std::size_t first = 0, last = 0; first < list.size(); first = last) {
      while (last < list.size() && list[last].edge == list[first].edge) ++last;
      const Joined here = join_around(std::span(list).subspan(first, last - first));
      if (here == Joined::impossible) return here;
      if (here == Joined::some) all = here;
    }
    return all;
  }

  Joined join_around(std::span<const AtEdge> around) {
    // runs of one part around the edge
    std::vector<std::vector<SimplexIndex>> runs;
    std::vector<char> seen(around.size(), 0);
    const auto place = [&](SimplexIndex t) {
      return static_cast<std::size_t>(
          std::lower_bound(around.begin(), around.end(), t,
                           [](const AtEdge& a, SimplexIndex b) { return a.tetrahedron < b; }) -
          around.begin());
    };
    const auto at_edge = [&](SimplexIndex t) {
      const std::size_t n = place(t);
      return n < around.size() && around[n].tetrahedron == t;
    };
    for (std::size_t n = 0; n < around.size(); ++n) {
      if (seen[n]) continue;
      seen[n] = 1;
      runs.push_back({around[n].tetrahedron});
      for (std::size_t m = 0; m < runs.back().size(); ++m) {
        const SimplexIndex t = runs.back()[m];
        for (std::size_t k = 0; k < 4; ++k) {
          const SimplexIndex next = mesh_.neighbour[t][k];
          if (!exists(next) || part(next) != part(t) || !at_edge(next) || seen[place(next)]) continue;
          // across a face that holds the edge
          const NodeIndex opposite = mesh_.node[t][k];
          if (opposite == around[0].edge[0] || opposite == around[0].edge[1]) continue;
          seen[place(next)] = 1;
          runs.back().push_back(next);
        }
      }
    }
    for (std::size_t a = 0; a < runs.size(); ++a)
      for (std::size_t b = a + 1; b < runs.size(); ++b) {
        if (part(runs[a][0]) != part(runs[b][0])) continue;
        for (const std::size_t r : runs[a].size() <= runs[b].size() ? std::array{a, b} : std::array{b, a})
          if (give_away(runs[r])) return Joined::some;
        return Joined::impossible; // both hold what has to stay
      }
    return Joined::none_needed;
  }

  /// The blocks of these tetrahedra go to the part beside them with which they share most of what is cut.
  bool give_away(const std::vector<SimplexIndex>& run) {
    std::vector<std::int32_t> blocks;
    for (const SimplexIndex t : run) {
      if (is_seed_[index_of(block_[t])]) return false;
      blocks.push_back(block_[t]);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    std::vector<std::pair<std::int32_t, double>> shared;
    for (const Passage& passage : passages_)
      for (const auto& [own, other] : {std::pair(passage.from, passage.to), {passage.to, passage.from}}) {
        if (!std::binary_search(blocks.begin(), blocks.end(), own)) continue;
        const std::int32_t there = part_of_block_[index_of(other)];
        if (there == part_of_block_[index_of(own)]) continue;
        const auto found =
            std::find_if(shared.begin(), shared.end(), [&](const auto& s) { return s.first == there; });
        if (found == shared.end())
          shared.emplace_back(there, passage.weight);
        else
          found->second += passage.weight;
      }
    if (shared.empty()) return false;
    const auto best = std::max_element(shared.begin(), shared.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const std::int32_t b : blocks) part_of_block_[index_of(b)] = best->first;
    return true;
  }

  /// Numbers without gaps, the first tetrahedron's part being 0.
  Parts numbered() const {
    Parts result(mesh_.node.size());
    std::vector<std::int32_t> name(blocks_ + 1, -1);
    std::int32_t next = 0;
    for (const SimplexIndex t : mesh_.node.indices()) {
      std::int32_t& n = name[index_of(part(t))];
      if (n < 0) n = next++;
      result[t] = n;
    }
    if (next == 1) result.clear();
    return result;
  }

  const Cloud<3>& cloud_;
  const Tetrahedra& mesh_;
  const Field& broken_;
  int least_part_;
  IndexedVector<SimplexIndex, std::int32_t> block_;
  std::size_t blocks_ = 0;
  std::vector<std::size_t> component_; ///< [block] the first tetrahedron of what hangs together
  std::vector<Passage> passages_;
  std::vector<char> is_seed_;                    ///< [block]
  std::vector<std::vector<std::int32_t>> seeds_; ///< of each component
  std::vector<std::int32_t> part_of_block_;
};

} // namespace

IndexedVector<SimplexIndex, std::int32_t> parts_between(const Cloud<3>& cloud, const Tetrahedra& mesh,
                                                        const Field& broken, int least_part) {
  return Cut(cloud, mesh, broken, least_part).parts();
}

} // namespace cnem::adapt
