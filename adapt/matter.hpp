#pragma once
// The matter at the nodes of a cloud while it is being resampled, in the plane and in space.
#include "core/fields/aligned.hpp"
#include "core/index.hpp"
#include "core/indexed.hpp"
#include "core/operators/resampling.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace cnem::adapt {

/// What resampling has to know of a node. Each list is [node]; held nodes that are doubled stay both.
struct NodeProperties {
  Field mass;     ///< kg/m (kg of revolution, in space), carried
  Field jacobian; ///< J, volume over the stress-free one, –; mixes with mass, as volumes add
  Field density;  ///< kg/m³ at J = 1; a label
  Field size;     ///< m, wanted spacing; a label
  IndexedVector<NodeIndex, char> held; ///< corners and nodes that conditions name: they stay
  Field broken; ///< – from 1 on it carries nothing, larger ones part first; a label; empty: nothing breaks
  /// What may not mix, the material for example: a label, one in each part that the boundary divides the
  /// domain into. Empty: all may.
  IndexedVector<NodeIndex, std::int32_t> part{};

  /// m³, what the matter of a node fills.
  double filled(NodeIndex i) const {
    return mass[index_of(i)] * jacobian[index_of(i)] / density[index_of(i)];
  }
  /// Broken matter, which bears no tension, that has opened beyond four times its volume; that of lips which
  /// slide on each other opens less.
  bool is_debris(NodeIndex i) const {
    constexpr double opened = 4.0;
    return !broken.empty() && broken[index_of(i)] >= 1.0 && jacobian[index_of(i)] > opened;
  }
  /// kg/m (kg of revolution), what a node's share of the body holds now, where that is not its cell: of a
  /// cloud whose nodes stay. Empty: ρ₀ V/J of its cell.
  Field matter{};
};

/// Part of a node's matter on its way to another.
struct Parcel {
  NodeIndex from, to;
  double fraction; ///< of what `from` had at the start of the round
};

/// Sorted sparse row over the nodes the resampling began with.
using Row = std::vector<std::pair<NodeIndex, double>>;

/// What nodes have, and what they were made of.
class Matter {
public:
  explicit Matter(NodeProperties properties);

  const NodeProperties& node() const { return node_; }
  bool may_mix(NodeIndex i, NodeIndex k) const {
    return node_.part.empty() || node_.part[i] == node_.part[k];
  }
  bool held(NodeIndex i) const { return node_.held[i] != 0; }
  bool is_debris(NodeIndex i) const { return node_.is_debris(i); }
  double size_between(NodeIndex a, NodeIndex b) const {
    return 0.5 * (node_.size[index_of(a)] + node_.size[index_of(b)]);
  }
  /// The number at the start; none: inserted.
  NodeIndex old_of(NodeIndex i) const { return old_of_[i]; }
  /// Whether there are others than at the start.
  bool came_or_went() const;

  /// Carries matter over. No node may be both at the `from` of one parcel and at the `to` of another.
  void move(const std::vector<Parcel>& parcels);
  /// Moves at once; `fraction` of what `from` has now.
  void move_now(NodeIndex from, NodeIndex to, double fraction);

protected:
  /// A node without matter, with the mean of labels of others.
  void append(const std::vector<std::pair<NodeIndex, double>>& parents);
  void hold(NodeIndex i, char held) { node_.held[i] = held; }
  /// New numbers of all nodes, as renumber().
  void renumber(const IndexedVector<NodeIndex, NodeIndex>& number);
  /// Everything since construction on a cloud of the present nodes.
  template<int dim> Resampling<dim> finished(const Cloud<dim>& cloud) const;

private:
  Row& row(IndexedVector<NodeIndex, Row>& rows, NodeIndex i);
  NodeRows rows_of_nodes(const IndexedVector<NodeIndex, Row>& rows) const;

  NodeProperties node_;
  std::size_t old_nodes_;
  IndexedVector<NodeIndex, NodeIndex> old_of_;     ///< number at the start; none: inserted
  IndexedVector<NodeIndex, Row> parcels_, labels_; ///< empty: the old node itself, if there was one
};

/// Numbers after those with a mark have been dropped; none for these.
IndexedVector<NodeIndex, NodeIndex> numbers_without(const IndexedVector<NodeIndex, char>& gone);
/// Puts what a list, [node], has of each to its new number; what has none goes.
template<class List> void renumber(const IndexedVector<NodeIndex, NodeIndex>& number, List& list) {
  List kept(index_of(std::count_if(number.begin(), number.end(), [](NodeIndex i) { return exists(i); })));
  for (std::size_t i = 0; i < number.size(); ++i)
    if (const NodeIndex n = number[as<NodeIndex>(i)]; exists(n)) kept[index_of(n)] = std::move(list[i]);
  list = std::move(kept);
}

} // namespace cnem::adapt
