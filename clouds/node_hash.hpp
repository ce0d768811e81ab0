#pragma once
// Nodes of strongly varying spacing in a hierarchy of hashed grids: near neighbours in constant time.
#include "core/vec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace cnem::clouds {

/// Each node lives on the grid whose cells are between two and four times its spacing.
template<int dim> class NodeHash {
public:
  /// h_min: the smallest spacing, h_max: the largest; growth: the Lipschitz constant of the spacing field.
  NodeHash(double h_min, double h_max, double growth);

  void insert(const Vec<dim>& x, double h);
  /// Whether a node y lies nearer to x than factor (h(x) + h(y))/2.
  bool crowded(const Vec<dim>& x, double h, double factor) const;

private:
  struct Node {
    Vec<dim> x;
    double h;
    std::int32_t next;
  };
  struct Slot {
    std::uint64_t key = empty;
    std::int32_t first = -1;
  };
  static constexpr std::uint64_t empty = ~std::uint64_t{0};

  int level(double h) const;
  double cell_size(int level) const;
  std::array<std::int64_t, dim> cell(const Vec<dim>& x, double size) const;
  std::size_t slot(std::uint64_t key) const;
  void enlarge();

  double h_min_;
  int levels_;
  double growth_;
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

/// A place without a node, and how far it is from others over the wanted spacing.
template<int dim> struct Hole {
  double size;
  Vec<dim> centre; ///< m
};

/// The centres of holes, the largest first, that are not near larger ones. Spacing: at(x), finest(), growth()
/// and the largest as `spacing`, m.
template<int dim, class Spacing>
std::vector<Vec<dim>> centres_apart(std::vector<Hole<dim>> holes, const Spacing& spacing) {
  std::ranges::stable_sort(holes, std::ranges::greater{}, &Hole<dim>::size);
  NodeHash<dim> placed(spacing.finest(), spacing.spacing, spacing.growth());
  std::vector<Vec<dim>> centres;
  for (const Hole<dim>& candidate : holes) {
    const double h = spacing.at(candidate.centre);
    if (placed.crowded(candidate.centre, h, 0.9)) continue;
    placed.insert(candidate.centre, h);
    centres.push_back(candidate.centre);
  }
  return centres;
}

} // namespace cnem::clouds
