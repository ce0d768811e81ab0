#pragma once
// Rows of nodal operators while they are summed up.
#include "core/indexed.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operators.hpp"
#include "core/vec.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace cnem::scni {

/// One row: entries are found through a table over all nodes.
template<int dim> class RowAccumulator {
public:
  explicit RowAccumulator(int nodes) : slot_(index_of(nodes), -1) {}

  void add(NodeIndex node, const Vec<dim>& b, double value = 0.0) {
    std::int32_t& slot = slot_[node];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(entry_.size());
      node_.push_back(node);
      entry_.push_back({b, value});
    } else {
      entry_[index_of(slot)].b += b;
      entry_[index_of(slot)].value += value;
    }
  }

  struct Entry {
    Vec<dim> b;
    double value; ///< at the centroid, of revolution
  };

  /// Calls body(node, entry) in the order of the nodes and empties the row.
  template<class Body> void take(Body&& body) {
    std::sort(node_.begin(), node_.end());
    for (const NodeIndex node : node_) {
      body(node, entry_[index_of(slot_[node])]);
      slot_[node] = -1;
    }
    node_.clear();
    entry_.clear();
  }

private:
  IndexedVector<NodeIndex, std::int32_t> slot_; ///< index into entry_, −1: none
  std::vector<NodeIndex> node_;
  std::vector<Entry> entry_;
};

/// The rows of a block of nodes.
template<int dim> struct RowBlock {
  std::vector<NodeIndex> node;
  std::array<std::vector<double>, dim> gradient;
  std::vector<double> hoop;
};

/// An operator and its rows that are yet to be put one after another.
template<int dim> struct UnjoinedRows {
  DiscreteOperators<dim> op;
  std::vector<RowBlock<dim>> block;
};

/// Sums up the rows of nodal operators on whose nodes, volumes and, of revolution, radii are known: sum(i,
/// row) adds to the row of node i and gives what its gradients are divided by.
template<int dim, class Sum> std::vector<RowBlock<dim>> sum_rows(DiscreteOperators<dim>& op, Sum&& sum) {
  using Block = RowBlock<dim>;
  const auto nodes = index_of(op.nodes);
  const bool revolution = op.of_revolution();
  op.row_begin.assign(nodes + 1, 0);
  std::vector<Block> list(blocks(nodes));
  const auto fill = [&](std::size_t k, RowAccumulator<dim>& row) {
    Block& block = list[k];
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    constexpr std::size_t expected = dim == 2 ? 11 : 30;
    block.node.reserve(expected * (last - first));
    for (auto& g : block.gradient) g.reserve(expected * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const double measure = sum(i, row);
      row.take([&](NodeIndex node, const auto& entry) {
        block.node.push_back(node);
        for (std::size_t d = 0; d < dim; ++d)
          block.gradient[d].push_back(entry.b[static_cast<Eigen::Index>(d)] / measure);
        if (revolution) block.hoop.push_back(entry.value / op.radius[i]);
      });
      op.row_begin[i + 1] = static_cast<std::int32_t>(block.node.size()); // of the block, so far
    }
  };
  ParallelFailure failure;
#pragma omp parallel
  {
    std::optional<RowAccumulator<dim>> row;
#pragma omp for schedule(dynamic)
    for (std::size_t k = 0; k < list.size(); ++k)
      failure.guard(static_cast<std::ptrdiff_t>(k), [&] {
        if (!row) row.emplace(op.nodes);
        fill(k, *row);
      });
  }
  failure.rethrow();
  return list;
}

/// Puts the rows one after another. Each block is let go of as soon as it is copied.
template<int dim> void join_rows(DiscreteOperators<dim>& op, std::vector<RowBlock<dim>> list) {
  const auto nodes = index_of(op.nodes);
  const bool revolution = op.of_revolution();
  std::vector<std::int32_t> offset(list.size() + 1, 0);
  for (std::size_t k = 0; k < list.size(); ++k)
    offset[k + 1] = offset[k] + static_cast<std::int32_t>(list[k].node.size());
  op.node.resize(index_of(offset.back()));
  for (Field& g : op.gradient) g.resize(index_of(offset.back()));
  if (revolution) op.hoop.resize(index_of(offset.back()));
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::size_t first = k * block_size, last = std::min(first + block_size, nodes);
    for (std::size_t i = first; i < last; ++i) op.row_begin[i + 1] += offset[k];
    std::copy(list[k].node.begin(), list[k].node.end(), op.node.begin() + offset[k]);
    for (std::size_t d = 0; d < dim; ++d)
      std::copy(list[k].gradient[d].begin(), list[k].gradient[d].end(), op.gradient[d].begin() + offset[k]);
    std::copy(list[k].hoop.begin(), list[k].hoop.end(), op.hoop.begin() + (revolution ? offset[k] : 0));
    list[k] = {};
  }
}

template<int dim> DiscreteOperators<dim> joined(UnjoinedRows<dim> rows) {
  join_rows(rows.op, std::move(rows.block));
  return std::move(rows.op);
}

/// Fills in the rows of an operator, and its transpose: sums them up and puts them one after another.
template<int dim, class Sum> void fill_rows(DiscreteOperators<dim>& op, Sum&& sum) {
  join_rows(op, sum_rows(op, sum));
  op.build_transpose();
}

} // namespace cnem::scni
