#include "mechanics/ties.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem {

template<int dim>
Ties<dim>::Ties(const std::vector<std::array<NodeIndex, 2>>& pairs,
                const IndexedVector<NodeIndex, Vec<dim>>& position) {
  if (pairs.empty()) return;
  IndexedVector<NodeIndex, NodeIndex> root(position.size());
  for (const NodeIndex i : root.indices()) root[i] = i;
  const auto find = [&](NodeIndex i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    const NodeIndex low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
    root[high] = low;
  }
  IndexedVector<NodeIndex, std::int32_t> members(position.size(), 0);
  for (const NodeIndex i : members.indices()) ++members[find(i)];
  group_.assign(position.size(), -1);
  begin_.push_back(0);
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
  for (const NodeIndex i : node_) {
    const NodeIndex leader = node_[index_of(begin_[index_of(group_[i])])];
    offset_.push_back(position[i] - position[leader]);
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

template<int dim>
double Ties<dim>::share_motion(const Field& mass, double dt, Fields<dim>& velocity,
                               Fields<dim>& position) const {
  const auto kinetic = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (const NodeIndex i : node_)
        sum += 0.5 * mass[index_of(i)] * velocity[k][index_of(i)] * velocity[k][index_of(i)];
    return sum;
  };
  const double before = kinetic();
  for (std::size_t k = 0; k < dim; ++k) {
    std::vector<double> old(begin_.size());
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g)
      old[g] = velocity[k][index_of(node_[index_of(begin_[g])])];
    share(mass, velocity[k]);
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g) {
      const auto leader = index_of(node_[index_of(begin_[g])]);
      position[k][leader] += dt * (velocity[k][leader] - old[g]);
      for (std::int32_t m = begin_[g] + 1; m < begin_[g + 1]; ++m)
        position[k][index_of(node_[index_of(m)])] =
            position[k][leader] + offset_[index_of(m)][static_cast<Eigen::Index>(k)];
    }
  }
  return before - kinetic();
}

template class Ties<2>;
template class Ties<3>;

} // namespace cnem
