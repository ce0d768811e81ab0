#pragma once
// Two facets of a surface in space that cross each other: how deep, where, and which way they part.
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"
#include "voronoi/space/winding.hpp"

#include <array>
#include <vector>

namespace cnem::adapt {

/// Looks at a cloud where it is at each call. size: [node] m, wanted spacing.
class CrossingFacets {
public:
  using Pair = std::array<CloudFacetIndex, 2>;

  CrossingFacets(const Cloud<3>& cloud, const Field& size) : cloud_(cloud), size_(size) {}

  Vec3 normal(CloudFacetIndex f) const; ///< m², as long as the area

  /// Whether they have no node in common and look at each other, or away from each other.
  bool facing(const Pair& pair) const;
  /// m, between the points farthest apart that they have in common.
  double common_length(const Pair& pair) const;
  /// Whether it is matter that has been between them: above both of them the surface is inside out. Else it
  /// has been a gap, and below both of them matter is twice.
  bool were_back_to_back(const Pair& pair, const voronoi::Winding& winding) const;
  /// m, how far the corners of f are above the plane of g (sign 1) or below it (-1).
  double reach(CloudFacetIndex f, CloudFacetIndex g, double sign) const;

  struct Overlap {
    double depth; ///< m, of the one that is entered less deep
    Vec3 way;     ///< –, along its normal, on which the first of the pair leaves the second
  };
  Overlap overlap(const Pair& pair, const voronoi::Winding& winding) const;

private:
  bool share_a_node(const Pair& pair) const;
  std::vector<Vec3> common_points(const Pair& pair) const;
  Vec3 middle(const Pair& pair) const;

  const Cloud<3>& cloud_;
  const Field& size_;
};

} // namespace cnem::adapt
