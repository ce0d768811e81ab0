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
    while (root[u(i)] != i) i = root[u(i)] = root[u(root[u(i)])];
    return i;
  };
  for (const auto& [a, b] : pairs) {
    const std::int32_t low = std::min(find(a), find(b)), high = std::max(find(a), find(b));
    root[u(high)] = low;
  }
  std::vector<std::int32_t> members(nodes, 0);
  for (std::size_t i = 0; i < nodes; ++i) ++members[u(find(static_cast<std::int32_t>(i)))];
  group_.assign(nodes, -1);
  begin_.push_back(0);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (members[i] < 2) continue;
    group_[i] = static_cast<std::int32_t>(begin_.size()) - 1;
    begin_.push_back(begin_.back() + members[i]);
  }
  node_.resize(u(begin_.back()));
  std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto top = u(find(static_cast<std::int32_t>(i)));
    group_[i] = group_[top];
    if (group_[i] >= 0) node_[u(next[u(group_[i])]++)] = static_cast<std::int32_t>(i);
  }
  for (const std::int32_t i : node_) {
    const std::int32_t leader = node_[u(begin_[u(group_[u(i)])])];
    offset_.push_back(position[u(i)] - position[u(leader)]);
  }
}

template<int dim> std::vector<std::int32_t> Ties<dim>::with_partners(std::vector<std::int32_t> nodes) const {
  if (empty()) return nodes;
  std::vector<bool> listed(group_.size(), false);
  for (const std::int32_t i : nodes) listed[u(i)] = true;
  const std::size_t given = nodes.size();
  for (std::size_t k = 0; k < given; ++k) {
    const std::int32_t g = group_[u(nodes[k])];
    if (g < 0) continue;
    for (std::int32_t m = begin_[u(g)]; m < begin_[u(g + 1)]; ++m) {
      const std::int32_t partner = node_[u(m)];
      if (listed[u(partner)]) continue;
      listed[u(partner)] = true;
      nodes.push_back(partner);
    }
  }
  return nodes;
}

template<int dim> void Ties<dim>::share(const Field& weight, Field& value) const {
  for (std::size_t g = 0; g + 1 < begin_.size(); ++g) {
    double sum = 0.0, total = 0.0;
    for (std::int32_t m = begin_[g]; m < begin_[g + 1]; ++m) {
      const auto i = u(node_[u(m)]);
      sum += weight[i] * value[i];
      total += weight[i];
    }
    for (std::int32_t m = begin_[g]; m < begin_[g + 1]; ++m) value[u(node_[u(m)])] = sum / total;
  }
}

template<int dim>
double Ties<dim>::share_motion(const Field& mass, double dt, Fields<dim>& velocity,
                               Fields<dim>& position) const {
  const auto kinetic = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < dim; ++k)
      for (const std::int32_t i : node_) sum += 0.5 * mass[u(i)] * velocity[k][u(i)] * velocity[k][u(i)];
    return sum;
  };
  const double before = kinetic();
  for (std::size_t k = 0; k < dim; ++k) {
    std::vector<double> old(begin_.size());
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g) old[g] = velocity[k][u(node_[u(begin_[g])])];
    share(mass, velocity[k]);
    for (std::size_t g = 0; g + 1 < begin_.size(); ++g) {
      const auto leader = u(node_[u(begin_[g])]);
      position[k][leader] += dt * (velocity[k][leader] - old[g]);
      for (std::int32_t m = begin_[g] + 1; m < begin_[g + 1]; ++m)
        position[k][u(node_[u(m)])] = position[k][leader] + offset_[u(m)][static_cast<Eigen::Index>(k)];
    }
  }
  return before - kinetic();
}

template class Ties<2>;
template class Ties<3>;

} // namespace cnem
