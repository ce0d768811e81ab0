#pragma once
// A cloud while it is being resampled: nodes come and go, and mass goes with them in parcels.
#include "adapt/matter.hpp"
#include "adapt/plane/structure.hpp"

#include <span>
#include <utility>
#include <vector>

namespace cnem::adapt {

class WorkingCloud : public Matter {
public:
  /// free_piece: the boundary piece whose ends may go, because nothing refers to it (faces that separation
  /// made). Throws GeometryError when the facets of the cloud do not form loops.
  WorkingCloud(const Cloud<2>& cloud, NodeProperties properties, PieceIndex free_piece = PieceIndex::none);

  const Cloud<2>& cloud() const { return cloud_; }
  std::size_t size() const { return cloud_.position.size(); }
  IndexRange<NodeIndex> nodes() const { return cloud_.position.indices(); }
  bool on_boundary(NodeIndex i) const { return exists(next_[i]); }
  NodeIndex next(NodeIndex i) const { return next_[i]; } ///< along the boundary; none inside
  NodeIndex previous(NodeIndex i) const { return previous_[i]; }
  PieceIndex piece(NodeIndex i) const { return piece_[i]; } ///< of the facet that leaves it
  /// The start of the mate of the facet that leaves a boundary node; none where it has none.
  NodeIndex facing(NodeIndex i) const { return facing_[i]; }
  /// Whether a facet at a boundary node has a mate.
  bool has_mates(NodeIndex i) const { return exists(facing_[i]) || exists(facing_[previous_[i]]); }
  /// The node on the other face that comes and goes with a boundary node; none where the facets at the node
  /// have no mates, or not the same node between them (tips, ends of faces, places where faces meet).
  NodeIndex mate(NodeIndex i) const;
  /// Whether the boundary turns back at a node so that the body lies round it: the tip of a crack.
  bool is_tip(NodeIndex i) const;
  /// Facets change pieces here, and the node has to stay for it: it is an end of named boundaries, or beside
  /// the free piece the end of the last facet of another.
  bool ends_piece(NodeIndex i) const;
  /// A boundary node that may not go: it is held, ends a piece or mates, or its mate may not.
  bool stays(NodeIndex i) const;

  /// Adds a node without matter between two others, or on the facet a → b of the boundary: half-way, or at
  /// `place`, 0 at a and 1 at b. Returns its number. Where the facet has a mate the next number is that of
  /// the node in the middle of the mate: its place is half-way then.
  NodeIndex insert_between(NodeIndex a, NodeIndex b, bool on_boundary, double place = 0.5);
  /// Adds an interior node without matter at x, the mean of a triangle's nodes with these weights.
  NodeIndex insert_at(const Vec2& x, const std::array<NodeIndex, 3>& corner,
                      const std::array<double, 3>& weight);
  /// Makes an interior node part of the facet a → next(a), which has no mate, at x.
  void promote(NodeIndex node, NodeIndex a, const Vec2& x);
  /// Takes the boundary past a node and its mate, which become interior ones (to be removed). The free piece
  /// takes over from others.
  void bypass(NodeIndex node);
  /// The facet that leaves a node goes over to the piece of the next one.
  void take_next_piece(NodeIndex i) { piece_[i] = piece_[next_[i]]; }
  PieceIndex free_piece() const { return free_piece_; }
  /// Puts a node elsewhere; what it has goes with it.
  void place(NodeIndex node, const Vec2& x) { cloud_.position[node] = x; }
  /// Opens the domain along a path from a boundary node over interior ones to another boundary node, or to an
  /// interior one that becomes the tip of a crack: nodes are doubled, but for the tip, and the two faces
  /// stand `gap` (m) apart, but for ends on mates, whose doubles stay where they are, as twins. Returns the
  /// pairs {old node, its double without matter}.
  std::vector<std::array<NodeIndex, 2>> open(std::span<const NodeIndex> path, PieceIndex piece, double gap);
  /// Drops nodes that have no matter left; renumbers. Returns the new number of each, none for the dropped.
  IndexedVector<NodeIndex, NodeIndex> drop(const IndexedVector<NodeIndex, char>& gone);
  /// Writes the facets of the loops into cloud().
  void refresh_facets();
  /// Where triangulating cloud() begins (Cloud::simplices), until nodes come or go.
  void begin_with(IndexedVector<SimplexIndex, std::array<NodeIndex, 3>> simplices,
                  IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>> across) {
    cloud_.simplices = std::move(simplices);
    cloud_.across = std::move(across);
  }

  /// Everything since construction, with the nodes in space-filling order when any came or went.
  Resampling<2> finish();

private:
  bool ends_mates(NodeIndex i) const;
  void divide(NodeIndex a, NodeIndex made);
  void pass_by(NodeIndex node);
  void be_mates(NodeIndex a, NodeIndex b);
  void renew_loops();
  NodeIndex append(const Vec2& x, const std::vector<std::pair<NodeIndex, double>>& parents);

  Cloud<2> cloud_;
  PieceIndex free_piece_;
  IndexedVector<NodeIndex, NodeIndex> next_, previous_; ///< along the boundary
  IndexedVector<NodeIndex, PieceIndex> piece_;          ///< of the facet that leaves it
  IndexedVector<NodeIndex, NodeIndex> facing_;          ///< start of the mate of the facet that leaves it
  std::vector<NodeIndex> loop_;                         ///< a node of each loop, in order
};

} // namespace cnem::adapt
