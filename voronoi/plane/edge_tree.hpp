#pragma once
// Where a point stands to the boundary of a cloud: inside or outside, and how far away.
#include "core/geometry/cloud.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// A balanced tree of bounding boxes over the facets of a cloud. Positions are copied. Queries are O(log N).
class EdgeTree {
public:
  explicit EdgeTree(const Cloud<2>& cloud);

  /// Distance from x to the nearest facet, m; `bound` when none is nearer than that.
  double distance(const Vec2& x, double bound) const;

  /// Whether x lies inside the polygon of all facets (even-odd rule; faces of cracks cancel). On a facet
  /// either answer may come.
  bool inside(const Vec2& x) const;

private:
  struct Box {
    Vec2 low, high;
  };
  static constexpr int leaf_size = 4;

  std::vector<std::array<Vec2, 2>> edges_; ///< in space-filling order, each from its lower end to its upper
  std::vector<Box> boxes_;                 ///< children of k: 2k + 1, 2k + 2
  int first_leaf_ = 0;
};

} // namespace cnem::voronoi
