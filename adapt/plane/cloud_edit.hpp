#pragma once
// A cloud of which some nodes go and others come at once, and with them matter (adapt/plane/window.hpp).
#include "adapt/plane/working_cloud.hpp"

#include <optional>
#include <vector>

namespace cnem::adapt {

/// Nodes, and the boundary as a list of who follows whom. What is passed to it has to outlive it.
class CloudEdit {
public:
  CloudEdit(const Cloud<2>& cloud, const Structure& structure, const NodeProperties& node);

  const Vec2& at(NodeIndex i) const { return place_[i]; }
  bool on_boundary(NodeIndex i) const { return exists(next_[i]); }
  bool has_mates(NodeIndex i) const { return exists(facing_[i]) || exists(facing_[previous_[i]]); }
  NodeIndex next(NodeIndex i) const { return next_[i]; }
  NodeIndex previous(NodeIndex i) const { return previous_[i]; }
  PieceIndex piece(NodeIndex i) const { return piece_[i]; }          ///< of the facet that leaves it
  double size(NodeIndex i) const { return node_.size[index_of(i)]; } ///< m, wanted spacing of an old node
  IndexRange<NodeIndex> old_nodes() const { return before_.position.indices(); }
  bool gone(NodeIndex i) const { return gone_[i] != 0; }

  void drop(NodeIndex i) { gone_[i] = 1; }
  /// A new node after an old one: of the same matter, or of virgin matter of the same kind.
  NodeIndex add(const Vec2& x, NodeIndex like, bool virgin = false);
  /// The boundary goes from a to b.
  void link(NodeIndex a, NodeIndex b, PieceIndex piece);

  /// The change as a whole: each node has matter for its cell. Empty where the boundary leads to a node that
  /// is gone, or the cloud has no valid structure.
  std::optional<Resampling<2>> finish();

private:
  struct Made {
    NodeIndex like;
    bool virgin;
  };

  bool renumber(Resampling<2>& change);
  IndexedVector<NodeIndex, char> touched(const Structure& after) const;
  void share_out(const Structure& after, Resampling<2>& change) const;
  bool is_old(NodeIndex i) const { return index_of(i) < before_.position.size(); }
  /// The number here of a node of the new cloud.
  NodeIndex number_here(NodeIndex p) const { return kept_[index_of(order_[index_of(p)])]; }

  const Cloud<2>& before_;
  const Structure& structure_;
  const NodeProperties& node_;
  IndexedVector<NodeIndex, Vec2> place_;
  IndexedVector<NodeIndex, NodeIndex> next_, previous_, facing_; ///< as those of WorkingCloud
  IndexedVector<NodeIndex, PieceIndex> piece_;
  IndexedVector<NodeIndex, char> gone_;
  std::vector<Made> made_;          ///< in the order of their numbers
  std::vector<NodeIndex> kept_;     ///< numbers here of the nodes that are left
  std::vector<std::int32_t> order_; ///< [new node] its place in kept_
};

} // namespace cnem::adapt
