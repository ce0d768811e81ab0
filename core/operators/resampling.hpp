#pragma once
// How the nodes of a new cloud are made of those of an old one, and what conditions hold on it.
#include "core/geometry/cloud.hpp"
#include "core/indexed.hpp"
#include "core/operators/parcels.hpp"

#include <span>
#include <utility>
#include <vector>

namespace cnem {

/// A change of the cloud by insertion, removal and exchange of mass between neighbours.
///
/// Matter goes over in parcels: new node p receives the fraction f_pk of old node k, so that Σ_p f_pk = 1 and
/// every sum over nodes of a quantity carried per mass is kept. A node that no parcel left or reached has the
/// row {itself, 1} and keeps its bits. Where a window moves with a tool, matter comes and goes besides
/// (`gain`, `virgin`). Labels are positions in a sense: initial positions, sizes; they are interpolated where
/// a node is inserted and otherwise stay with the node.
template<int dim> struct Resampling {
  Cloud<dim> cloud;                                ///< the new nodes, at their present positions
  NodeRows parcels;                                ///< f_pk, fractions of old nodes
  NodeRows labels;                                 ///< weights that sum to 1 over each row
  IndexedVector<NodeIndex, Vec<dim>> old_position; ///< [old node] m, present
  IndexedVector<NodeIndex, NodeIndex> new_of; ///< [old node] the new node that continues it; none: removed
  IndexedVector<NodeIndex, NodeIndex> old_of; ///< [new node] the old node that it continues; none: inserted
  /// Where the ends of a moving window let matter through: [old node] Σ_p f_pk − 1, what there is more of its
  /// matter than there was; −1: it was taken off. Empty: no matter came or went.
  Field gain{};
  /// New nodes of virgin matter, which is no gain of an old node: the one entry of their row says after which
  /// old node they take place, velocity and material, and how much mass they have of its mass.
  std::vector<NodeIndex> virgin{};
  /// Nodes stay where they are and exchange mass alone: what is known at their stress points is known there
  /// still.
  bool points_stay = false;

  /// Whether node p is other matter than one old node.
  bool mixed(std::size_t p) const { return parcels.mixed(p); }
  /// Whether matter came or went.
  bool open() const { return !gain.empty(); }
  /// The old node that a new one of virgin matter takes after, and its mass over the mass of that.
  std::pair<NodeIndex, double> model_of(NodeIndex p) const {
    const auto e = index_of(parcels.begin[index_of(p)]);
    return {parcels.from[e], parcels.weight[e]};
  }
};

/// Which facets and nodes a condition holds after a change of the cloud.
template<int dim>
std::vector<Facet<dim>> facets_of_pieces(const Cloud<dim>& cloud, std::span<const PieceIndex> pieces);
/// Old nodes that are still there, and all nodes of the given pieces; in increasing order.
template<int dim>
std::vector<NodeIndex> renumbered(const Resampling<dim>& change, std::span<const NodeIndex> nodes,
                                  std::span<const PieceIndex> pieces);
/// The pieces of a list of facets, each once, in increasing order.
template<int dim> std::vector<PieceIndex> pieces_of(std::span<const Facet<dim>> facets);
/// Replaces the facets that a condition holds by those of a new cloud on the same pieces.
template<int dim> void renew_facets(const Cloud<dim>& cloud, std::vector<Facet<dim>>& facets);

} // namespace cnem
