#pragma once
// Which of many things hang together.
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace cnem {

/// Sets of numbers below a count, each alone at first; the first of a set stands for it (union-find with
/// halved paths; Tarjan and van Leeuwen 1984). Nearly O(1) an operation.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t first(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = first(a), b = first(b);
    if (b < a) std::swap(a, b);
    parent_[b] = a;
  }

private:
  std::vector<std::size_t> parent_;
};

} // namespace cnem
