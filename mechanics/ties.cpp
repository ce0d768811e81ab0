#include "mechanics/ties.hpp"

#include "core/geometry/mates.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace cnem {

template<int dim>
Ties<dim>::Ties(const std::vector<std::array<NodeIndex, 2>>& pairs,
                const IndexedVector<NodeIndex, Vec<dim>>& position, std::vector<PieceIndex> pieces)
    : pieces_(std::move(pieces)) {
  if (pairs.empty()) return;
  group(pairs, position.size());
  for (const NodeIndex i : node_) offset_.push_back(position[i] - position[leader(i)]);
}

/// Everything but the offsets.
template<int dim>
void Ties<dim>::group(const std::vector<std::array<NodeIndex, 2>>& pairs, std::size_t nodes) {
  IndexedVector<NodeIndex, NodeIndex> root(nodes);
  for (const NodeIndex i : root.indices()) root[i] = i;
  const auto find = [&](NodeIndex i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    const NodeIndex low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
    root[high] = low;
  }
  IndexedVector<NodeIndex, std::int32_t> members(nodes, 0);
  for (const NodeIndex i : members.indices()) ++members[find(i)];
  group_.assign(nodes, -1);
  begin_.assign(1, 0);
  for (const NodeIndex i : members.indices()) {
    if (members[i] < 2) continue;
    group_[i] = as<std::int32_t>(begin_.size()) - 1;
    begin_.push_back(begin_.back() + members[i]);
  }
  node_.resize(index_of(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (const NodeIndex i : group_.indices()) {
    group_[i] = group_[find(i)];
    if (group_[i] >= 0) node_[index_of(next[index_of(group_[i])]++)] = i;
  }
}

template<int dim> void Ties<dim>::resample(const Resampling<dim>& change) {
  if (empty()) return;
  const Ties before = std::move(*this);
  pieces_ = before.pieces_;
  offset_.clear();
  group(mated_nodes(change.cloud, std::span<const PieceIndex>(pieces_)), change.cloud.position.size());
  IndexedVector<NodeIndex, const Vec<dim>*> old_offset(change.new_of.size(), nullptr);
  for (std::size_t m = 0; m < before.node_.size(); ++m) old_offset[before.node_[m]] = &before.offset_[m];
  for (const NodeIndex i : node_) {
    const NodeIndex first = leader(i), old = change.old_of[i], old_first = change.old_of[first];
    const bool kept = exists(old) && exists(old_first) && before.group_[old] >= 0 &&
                      before.group_[old] == before.group_[old_first];
    offset_.push_back(kept ? *old_offset[old] - *old_offset[old_first]
                           : change.cloud.position[i] - change.cloud.position[first]);
  }
}

template<int dim>
void Ties<dim>::archive_nodes(Archive& archive, const std::string& place, std::size_t nodes) {
  if (empty()) return;
  archive.integers(place + "/begin", begin_);
  archive.integers(place + "/node", node_);
  std::vector<double> offset;
  for (const Vec<dim>& x : offset_) offset.insert(offset.end(), x.begin(), x.end());
  archive.list(place + "/offset", "m", offset);
  if (!archive.loading()) return;
  offset_.assign(node_.size(), Vec<dim>::Zero());
  group_.assign(nodes, -1);
  for (std::size_t g = 0; g + 1 < begin_.size(); ++g)
    for (auto m = index_of(begin_[g]); m < index_of(begin_[g + 1]); ++m) {
      group_[node_[m]] = as<std::int32_t>(g);
      for (std::size_t k = 0; k < dim; ++k) offset_[m][static_cast<Eigen::Index>(k)] = offset[dim * m + k];
    }
}

template<int dim> std::vector<NodeIndex> Ties<dim>::with_partners(std::vector<NodeIndex> nodes) const {
  if (empty()) return nodes;
  IndexedVector<NodeIndex, bool> listed(group_.size(), false);
  for (const NodeIndex i : nodes) listed[i] = true;
  const std::size_t given = nodes.size();
  for (std::size_t k = 0; k < given; ++k) {
    const std::int32_t g = group_[nodes[k]];
    if (g < 0) continue;
    for (std::int32_t m = begin_[index_of(g)]; m < begin_[index_of(g + 1)]; ++m) {
      const NodeIndex partner = node_[index_of(m)];
      if (listed[partner]) continue;
      listed[partner] = true;
      nodes.push_back(partner);
    }
  }
  return nodes;
}

template<int dim> void Ties<dim>::share(const Field& weight, Field& value) const {
  for (std::size_t g = 0; g + 1 < begin_.size(); ++g) {
    double sum = 0.0, total = 0.0;
    for (std::int32_t m = begin_[g]; m < begin_[g + 1]; ++m) {
      const auto i = index_of(node_[index_of(m)]);
      sum += weight[i] * value[i];
      total += weight[i];
    }
    for (std::int32_t m = begin_[g]; m < begin_[g + 1]; ++m)
      value[index_of(node_[index_of(m)])] = sum / total;
  }
}

template<int dim> void Ties<dim>::align(Fields<dim>& position) const {
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g) {
      const auto first = index_of(node_[index_of(begin_[g])]);
      for (std::int32_t m = begin_[g] + 1; m < begin_[g + 1]; ++m)
        position[k][index_of(node_[index_of(m)])] =
            position[k][first] + offset_[index_of(m)][static_cast<Eigen::Index>(k)];
    }
}

template class Ties<2>;
template class Ties<3>;

} // namespace cnem
