#include "clouds/node_hash.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::clouds {

namespace {

std::uint64_t cell_key(int level, std::int64_t i, std::int64_t j) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << 29) - 1;
  return (static_cast<std::uint64_t>(level) << 58) | ((static_cast<std::uint64_t>(i) & mask) << 29) |
         (static_cast<std::uint64_t>(j) & mask);
}

} // namespace

NodeHash::NodeHash(double h_min, double h_max, double growth) : h_min_(h_min), levels_(1), growth_(growth) {
  levels_ = level(h_max) + 1;
  slots_.resize(1024);
}

int NodeHash::level(double h) const { return std::clamp(std::ilogb(h / h_min_), 0, 31); }

double NodeHash::cell_size(int level) const { return 2.0 * std::ldexp(h_min_, level); }

std::size_t NodeHash::slot(std::uint64_t key) const {
  std::uint64_t mixed = key * 0x9E3779B97F4A7C15U;
  mixed ^= mixed >> 32;
  std::size_t k = mixed & (slots_.size() - 1);
  while (slots_[k].key != empty && slots_[k].key != key) k = (k + 1) & (slots_.size() - 1);
  return k;
}

void NodeHash::enlarge() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& s : old)
    if (s.key != empty) slots_[slot(s.key)] = s;
}

void NodeHash::insert(const Vec2& x, double h) {
  const int l = std::min(level(h), levels_ - 1);
  const double size = cell_size(l);
  const auto i = static_cast<std::int64_t>(std::floor(x.x() / size));
  const auto j = static_cast<std::int64_t>(std::floor(x.y() / size));
  Slot& s = slots_[slot(cell_key(l, i, j))];
  if (s.key == empty) {
    s.key = cell_key(l, i, j);
    ++used_;
  }
  nodes_.push_back({x, h, s.first});
  s.first = static_cast<std::int32_t>(nodes_.size()) - 1;
  if (2 * used_ > slots_.size()) enlarge();
}

bool NodeHash::crowded(const Vec2& x, double h, double factor) const {
  const double reach = factor * h / (1.0 - 0.5 * factor * growth_); // no conflict beyond
  const int finest = level(std::max(h - growth_ * reach, h_min_));
  const int coarsest = std::min(level(h + growth_ * reach), levels_ - 1);
  for (int l = coarsest; l >= finest; --l) {
    const double size = cell_size(l);
    const auto i0 = static_cast<std::int64_t>(std::floor((x.x() - reach) / size));
    const auto i1 = static_cast<std::int64_t>(std::floor((x.x() + reach) / size));
    const auto j0 = static_cast<std::int64_t>(std::floor((x.y() - reach) / size));
    const auto j1 = static_cast<std::int64_t>(std::floor((x.y() + reach) / size));
    for (std::int64_t i = i0; i <= i1; ++i)
      for (std::int64_t j = j0; j <= j1; ++j)
        for (std::int32_t k = slots_[slot(cell_key(l, i, j))].first; k >= 0;
             k = nodes_[std::size_t(k)].next) {
          const Node& node = nodes_[std::size_t(k)];
          const double limit = 0.5 * factor * (h + node.h);
          if ((node.x - x).squaredNorm() < limit * limit) return true;
        }
  }
  return false;
}

} // namespace cnem::clouds
