#pragma once
// Nodes that move as one: the two faces of a bonded interface, the two sides of a periodic strip.
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/index.hpp"
#include "core/indexed.hpp"
#include "core/operators/resampling.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cnem {

/// Groups of tied nodes. Their velocities, and temperatures where asked for, are one; momentum and heat are
/// kept, because each group takes its weighted mean. Their positions keep the distance they started with: the
/// two sides of a bonded interface coincide to the last bit.
///
/// Tying never shortens the stable step: the largest eigenvalue of tied matrices lies below that of the free
/// ones (mechanics/stable_step.hpp has a bound on it).
template<int dim> class Ties {
public:
  Ties() = default;
  /// Pairs that share a node are merged. position: at the start, m. pieces: those of the boundary where nodes
  /// are tied to their mates (core/geometry/mates.hpp), also new ones.
  Ties(const std::vector<std::array<NodeIndex, 2>>& pairs, const IndexedVector<NodeIndex, Vec<dim>>& position,
       std::vector<PieceIndex> pieces = {});

  /// Ties the mates of a changed cloud. Nodes that were tied before keep their distance to the bit.
  void resample(const Resampling<dim>& change);
  /// Carries the groups on a resampled cloud out or in.
  void archive_nodes(Archive& archive, const std::string& place, std::size_t nodes);

  bool empty() const { return node_.empty(); }
  /// The number of its group, −1: free; empty when there are no ties.
  const IndexedVector<NodeIndex, std::int32_t>& group() const { return group_; }
  /// Tied nodes, group by group.
  const std::vector<NodeIndex>& nodes() const { return node_; }
  /// The list with all nodes tied to its members, each once, given ones first.
  std::vector<NodeIndex> with_partners(std::vector<NodeIndex> nodes) const;

  /// visit(nodes) for every group.
  template<class Visit> void each_group(Visit&& visit) const {
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g)
      visit(std::span(node_).subspan(index_of(begin_[g]), index_of(begin_[g + 1] - begin_[g])));
  }
  /// Every group's values become Σ w v / Σ w.
  void share(const Field& weight, Field& value) const;
  /// Puts members that have moved alike where the first of their group says, m: without rounding.
  void align(Fields<dim>& position) const;

private:
  void group(const std::vector<std::array<NodeIndex, 2>>& pairs, std::size_t nodes);
  NodeIndex leader(NodeIndex node) const { return node_[index_of(begin_[index_of(group_[node])])]; }

  std::vector<std::int32_t> begin_;              ///< [group + 1]
  std::vector<NodeIndex> node_;                  ///< members, in increasing order
  std::vector<Vec<dim>> offset_;                 ///< [member] m, from the first member of the group
  IndexedVector<NodeIndex, std::int32_t> group_; ///< −1: free
  std::vector<PieceIndex> pieces_;
};

extern template class Ties<2>;
extern template class Ties<3>;

} // namespace cnem
