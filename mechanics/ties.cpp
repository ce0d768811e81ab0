#include "mechanics/ties.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <numeric>

namespace cnem {

namespace {} // namespace

template<int dim>
Ties<dim>::Ties(const std::vector<std::array<std::int32_t, 2>>& pairs,
                const std::vector<Vec<dim>>& position) {
  if (pairs.empty()) return;
  const std::size_t nodes = position.size();
  std::vector<std::int32_t> root(nodes);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[index_of(i)] != i) i = root[index_of(i)] = root[index_of(root[index_of(i)])];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    const std::int32_t low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
    root[index_of(high)] = low;
  }
  std::vector<std::int32_t> members(nodes, 0);
  for (std::size_t i = 0; i < nodes; ++i) ++members[index_of(find(static_cast<std::int32_t>(i)))];
  group_.assign(nodes, -1);
  begin_.push_back(0);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (members[i] < 2) continue;
    group_[i] = static_cast<std::int32_t>(begin_.size()) - 1;
    begin_.push_back(begin_.back() + members[i]);
  }
  node_.resize(index_of(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto top = index_of(find(static_cast<std::int32_t>(i)));
    group_[i] = group_[top];
    if (group_[i] >= 0) node_[index_of(next[index_of(group_[i])]++)] = static_cast<std::int32_t>(i);
  }
  for (const std::int32_t i : node_) {
    const std::int32_t leader = node_[index_of(begin_[index_of(group_[index_of(i)])])];
    offset_.push_back(position[index_of(i)] - position[index_of(leader)]);
  }
}

template<int dim> std::vector<std::int32_t> Ties<dim>::with_partners(std::vector<std::int32_t> nodes) const {
  if (empty()) return nodes;
  std::vector<bool> listed(group_.size(), false);
  for (const std::int32_t i : nodes) listed[index_of(i)] = true;
  const std::size_t given = nodes.size();
  for (std::size_t k = 0; k < given; ++k) {
    const std::int32_t g = group_[index_of(nodes[k])];
    if (g < 0) continue;
    for (std::int32_t m = begin_[index_of(g)]; m < begin_[index_of(g + 1)]; ++m) {
      const std::int32_t partner = node_[index_of(m)];
      if (listed[index_of(partner)]) continue;
      listed[index_of(partner)] = true;
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
      for (const std::int32_t i : node_)
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
