#include "clouds/node_hash.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

/// Cells far from each other may share a key: what is found in them is too far away to matter.
template<std::size_t dim> std::uint64_t cell_key(int level, const std::array<std::int64_t, dim>& cell) {
  constexpr int bits = 58 / static_cast<int>(dim);
  constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  auto key = static_cast<std::uint64_t>(level);
  for (const std::int64_t i : cell) key = (key << bits) | (static_cast<std::uint64_t>(i) & mask);
  return key;
}

} // namespace

template<int dim>
NodeHash<dim>::NodeHash(double h_min, double h_max, double growth)
    : h_min_(h_min), levels_(1), growth_(growth) {
  levels_ = level(h_max) + 1;
  slots_.resize(1024);
}

template<int dim> int NodeHash<dim>::level(double h) const {
  return std::clamp(std::ilogb(h / h_min_), 0, 31);
}

template<int dim> double NodeHash<dim>::cell_size(int level) const { return 2.0 * std::ldexp(h_min_, level); }

template<int dim> std::size_t NodeHash<dim>::slot(std::uint64_t key) const {
  std::uint64_t mixed = key * 0x9E3779B97F4A7C15U;
  mixed ^= mixed >> 32;
  std::size_t k = mixed & (slots_.size() - 1);
  while (slots_[k].key != empty && slots_[k].key != key) k = (k + 1) & (slots_.size() - 1);
  return k;
}

template<int dim> void NodeHash<dim>::enlarge() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& s : old)
    if (s.key != empty) slots_[slot(s.key)] = s;
}

template<int dim> std::array<std::int64_t, dim> NodeHash<dim>::cell(const Vec<dim>& x, double size) const {
  std::array<std::int64_t, dim> at;
  for (int k = 0; k < dim; ++k)
    at[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(x[k] / size));
  return at;
}

template<int dim> void NodeHash<dim>::insert(const Vec<dim>& x, double h) {
  const int l = std::min(level(h), levels_ - 1);
  const std::uint64_t key = cell_key(l, cell(x, cell_size(l)));
  Slot& s = slots_[slot(key)];
  if (s.key == empty) {
    s.key = key;
    ++used_;
  }
  nodes_.push_back({x, h, s.first});
  s.first = static_cast<std::int32_t>(nodes_.size()) - 1;
  if (2 * used_ > slots_.size()) enlarge();
}

template<int dim> bool NodeHash<dim>::crowded(const Vec<dim>& x, double h, double factor) const {
  const double reach = factor * h / (1.0 - 0.5 * factor * growth_); // no conflict beyond
  const int finest = level(std::max(h - growth_ * reach, h_min_));
  const int coarsest = std::min(level(h + growth_ * reach), levels_ - 1);
  for (int l = coarsest; l >= finest; --l) {
    const double size = cell_size(l);
    const auto low = cell(x - Vec<dim>::Constant(reach), size),
               high = cell(x + Vec<dim>::Constant(reach), size);
    for (auto at = low;;) {
      for (std::int32_t k = slots_[slot(cell_key(l, at))].first; k >= 0; k = nodes_[std::size_t(k)].next) {
        const Node& node = nodes_[std::size_t(k)];
        const double limit = 0.5 * factor * (h + node.h);
        if ((node.x - x).squaredNorm() < limit * limit) return true;
      }
      std::size_t axis = 0;
      while (axis < dim && ++at[axis] > high[axis]) {
        at[axis] = low[axis];
        ++axis;
      }
      if (axis == dim) break;
    }
  }
  return false;
}

template class NodeHash<2>;
template class NodeHash<3>;

} // namespace cnem::clouds
