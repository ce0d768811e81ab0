#include "clouds/space/facet_tree.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <utility>

namespace cnem::clouds {
namespace {

TriangleSurface triangles_of(const Cloud<3>& cloud) {
  TriangleSurface surface;
  surface.points = cloud.position;
  for (const Facet<3>& facet : cloud.facets) {
    const auto& [a, b, c] = facet.node;
    surface.triangles.push_back({as<std::int32_t>(a), as<std::int32_t>(b), as<std::int32_t>(c)});
  }
  return surface;
}

} // namespace

FacetTree::FacetTree(const Cloud<3>& surface) : distance_(triangles_of(surface)) {
  std::vector<Box<3>> boxes;
  for (const Facet<3>& facet : surface.facets) {
    const DiametralBall ball = diametral_ball(corners_of(facet, surface.position));
    boxes.push_back({ball.centre.array() - ball.radius, ball.centre.array() + ball.radius});
    largest_ = std::max(largest_, ball.radius);
    balls_.push_back(ball);
  }
  tree_ = BoxTree(std::move(boxes));
}

FacetTree::Nearest FacetTree::nearest(const Vec3& x, double bound) const {
  const SurfaceDistance::Nearest found = distance_.nearest(x, bound);
  return {found.triangle < 0 ? bound : -found.distance, found.point, found.triangle};
}

bool FacetTree::in_ball(const Vec3& x, double factor) const {
  const double slack = std::max(0.0, factor - 1.0) * largest_;
  bool within = false;
  tree_.overlapping({x.array() - slack, x.array() + slack}, [&](std::int32_t f) {
    const DiametralBall& ball = balls_[index_of(f)];
    const double reach = factor * ball.radius;
    within = within || (x - ball.centre).squaredNorm() < reach * reach;
  });
  return within;
}

} // namespace cnem::clouds
