#pragma once
// Where a point stands to the surface of a cloud, and in whose balls.
#include "core/geometry/cloud.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/surface_distance.hpp"

namespace cnem::clouds {

/// The closed surface of a cloud with the diametral balls of its facets. Queries are O(log N).
class FacetTree {
public:
  explicit FacetTree(const Cloud<3>& surface);

  struct Nearest {
    double distance = 0.0; ///< m; negative outside
    Vec3 point{0, 0, 0};
    std::int32_t facet = -1;
  };

  /// The nearest point of the surface within `bound` (m). `facet` −1: there is none that near.
  Nearest nearest(const Vec3& x, double bound) const;

  /// Whether x lies within `factor` times the radius of the centre of a facet's smallest circumscribed ball.
  bool in_ball(const Vec3& x, double factor) const;

private:
  SurfaceDistance distance_;
  std::vector<DiametralBall> balls_; ///< [facet]
  BoxTree tree_;                     ///< of the balls
  double largest_ = 0.0;             ///< m, radius
};

} // namespace cnem::clouds
