#pragma once
// How often a surface goes round a point.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// Winding numbers by the facets above a point, with exact predicates: 1 inside, 0 outside; a point on a
/// facet counts as outside, two faces at one place as none. Facets stand in a grid of columns: O(facets) to
/// make, about O(1) a point.
class Winding {
public:
  explicit Winding(const Cloud<3>& cloud);
  int operator()(const Vec3& x) const;

private:
  std::array<std::size_t, 2> column(double x, double y) const;

  const Cloud<3>& cloud_;
  Vec2 low_;
  double spacing_ = 1.0;
  std::array<std::size_t, 2> columns_{1, 1};
  std::vector<std::uint32_t> begin_;
  std::vector<CloudFacetIndex> facets_; ///< column after column
};

} // namespace cnem::voronoi
