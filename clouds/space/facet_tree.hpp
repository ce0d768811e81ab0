#pragma once
// Where a point stands to a closed surface of triangles: inside or outside, how far away, and in whose balls.
#include "core/geometry/cloud.hpp"

#include <array>
#include <vector>

namespace cnem::clouds {

/// A balanced tree of boxes around the diametral balls of facets, which hold the facets. Queries are
/// O(log N).
class FacetTree {
public:
  explicit FacetTree(const Cloud<3>& surface);

  struct Nearest {
    double distance = 0.0; ///< m; negative outside
    Vec3 point{0, 0, 0};
    std::int32_t facet = -1;
  };

  /// The nearest point of the surface within `bound` (m). On which side x is, the angle-weighted normal there
  /// says (Bærentzen, Aanæs 2005). `facet` −1: there is none that near.
  Nearest nearest(const Vec3& x, double bound) const;

  /// Whether x lies within `factor` times the radius of the centre of a facet's smallest circumscribed ball.
  bool in_ball(const Vec3& x, double factor) const;

private:
  struct Box {
    Vec3 low, high;
  };
  struct Item {
    std::array<Vec3, 3> corner;
    std::array<NodeIndex, 3> node;
    Vec3 centre;
    double radius;
    std::int32_t facet;
  };
  static constexpr int leaf_size = 4;

  void build(int node, int begin, int end);
  Vec3 normal_at(const Item& item, const std::array<double, 3>& weight) const;

  std::vector<Item> items_;
  std::vector<Box> boxes_; ///< children of k: 2k + 1, 2k + 2
  std::vector<std::array<int, 2>> range_;
  IndexedVector<NodeIndex, Vec3> node_normal_;
  std::vector<std::array<Vec3, 3>> edge_normal_; ///< [facet][k] from its corner k to the next
  std::vector<Vec3> facet_normal_;
};

} // namespace cnem::clouds
