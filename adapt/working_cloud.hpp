#pragma once
// A cloud while it is being resampled: nodes come and go, and mass goes with them in parcels.
#include "adapt/structure.hpp"
#include "core/index.hpp"
#include "core/operators/resampling.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cnem::adapt {

/// What resampling has to know of a node. Each list is [node]; held nodes that are doubled stay both.
struct NodeProperties {
  Field mass;             ///< kg/m, carried
  Field jacobian;         ///< J, volume over the stress-free one, –; mixes with mass, as volumes add
  Field density;          ///< kg/m³ at J = 1; a label
  Field size;             ///< m, wanted spacing; a label
  std::vector<char> held; ///< corners and nodes that conditions name: they stay
  Field broken; ///< – from 1 on it carries nothing, larger ones part first; a label; empty: nothing breaks
};

/// Part of a node's matter on its way to another.
struct Parcel {
  std::int32_t from, to;
  double fraction; ///< of what `from` had at the start of the round
};

/// Sorted sparse row over the nodes the resampling began with.
using Row = std::vector<std::pair<std::int32_t, double>>;

class WorkingCloud {
public:
  /// free_piece: index of the boundary piece whose ends may go, because nothing refers to it (faces that
  /// separation made); −1: none. Throws GeometryError when the cloud has twins (cracks, interfaces) or its
  /// facets do not form loops.
  WorkingCloud(const Cloud<2>& cloud, NodeProperties properties, std::int32_t free_piece = -1);

  const Cloud<2>& cloud() const { return cloud_; }
  const NodeProperties& node() const { return node_; }
  std::size_t size() const { return cloud_.position.size(); }
  bool on_boundary(std::int32_t i) const { return next_[index(i)] >= 0; }
  std::int32_t next(std::int32_t i) const { return next_[index(i)]; } ///< along the boundary; −1 inside
  std::int32_t previous(std::int32_t i) const { return previous_[index(i)]; }
  std::int32_t piece(std::int32_t i) const { return piece_[index(i)]; } ///< of the facet that leaves it
  bool held(std::int32_t i) const { return node_.held[index(i)] != 0; }
  /// Facets change pieces here, and the node has to stay for it: it is an end of named boundaries, or all
  /// that keeps a piece beside the free one.
  bool ends_piece(std::int32_t i) const;
  double size_between(std::int32_t a, std::int32_t b) const {
    return 0.5 * (node_.size[index(a)] + node_.size[index(b)]);
  }

  /// Adds a node without matter between two others, or on the facet a → b of the boundary: half-way, or at
  /// `place`, 0 at a and 1 at b. Returns its number.
  std::int32_t insert_between(std::int32_t a, std::int32_t b, bool on_boundary, double place = 0.5);
  /// Adds an interior node without matter at x, the mean of a triangle's nodes with these weights.
  std::int32_t insert_at(const Vec2& x, const std::array<std::int32_t, 3>& corner,
                         const std::array<double, 3>& weight);
  /// Makes an interior node part of the facet a → next(a), at x.
  void promote(std::int32_t node, std::int32_t a, const Vec2& x);
  /// Takes the boundary past a node, which becomes an interior one (to be removed). The free piece takes over
  /// from others.
  void bypass(std::int32_t node);
  /// Puts a node elsewhere; what it has goes with it.
  void place(std::int32_t node, const Vec2& x) { cloud_.position[index(node)] = x; }
  /// Opens the domain along a path between two boundary nodes, over interior ones: nodes are doubled, and the
  /// two faces stand `gap` (m) apart. Returns the pairs {old node, its double without matter}.
  std::vector<std::array<std::int32_t, 2>> open(std::span<const std::int32_t> path, std::int32_t piece,
                                                double gap);
  /// Carries matter over. No node may be both at the `from` of one parcel and at the `to` of another.
  void move(const std::vector<Parcel>& parcels);
  /// Moves at once; `fraction` of what `from` has now.
  void move_now(std::int32_t from, std::int32_t to, double fraction);
  /// Drops nodes that have no matter left; renumbers. Returns [old number] → new number, −1 for the dropped.
  std::vector<std::int32_t> drop(const std::vector<char>& gone);
  /// Writes the facets of the loops into cloud().
  void refresh_facets();

  /// Everything since construction, with the nodes in space-filling order when any came or went.
  Resampling<2> finish();

private:
  static std::size_t index(std::int32_t i) { return index_of(i); }
  void renew_loops();
  Row& row(std::vector<Row>& rows, std::int32_t i);
  NodeRows in_order(std::vector<Row>& rows, const std::vector<std::int32_t>& order);
  std::int32_t append(const Vec2& x, const std::vector<std::pair<std::int32_t, double>>& parents);

  Cloud<2> cloud_;
  NodeProperties node_;
  std::size_t old_nodes_;
  std::int32_t free_piece_;
  std::vector<std::int32_t> next_, previous_; ///< [node] along the boundary
  std::vector<std::int32_t> piece_;           ///< [node] of the facet that leaves it
  std::vector<std::int32_t> loop_;            ///< a node of each loop, in order
  std::vector<std::int32_t> old_of_;          ///< [node] number at the start; −1: inserted
  std::vector<Row> parcels_, labels_;         ///< [node]; empty: the old node itself, if there was one
};

} // namespace cnem::adapt
