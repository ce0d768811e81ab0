#include "voronoi/plane/circumcircles.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <limits>

namespace cnem::voronoi {

Circumcircles circumcircles(const Cloud<2>& cloud, const Triangulation& mesh) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  Circumcircles circles;
  circles.centre.resize(mesh.node.size());
  circles.limit.resize(mesh.node.size());
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto& [i, j, k] = mesh.node[t];
    const Vec2& p = cloud.position[i];
    const Vec2 a = cloud.position[j] - p;
    const Vec2 b = cloud.position[k] - p;
    const double aa = a.squaredNorm(), bb = b.squaredNorm();
    // The triangle is counter-clockwise (exact predicates), but its area may round to nothing.
    const double twice_area = std::max(cross(a, b), 4.0 * epsilon * std::max(aa, bb));
    const Vec2 centre = right_normal(aa * b - bb * a) * (0.5 / twice_area);
    const double radius2 = centre.squaredNorm();
    circles.centre[t] = p + centre;
    circles.limit[t] =
        radius2 - 16.0 * epsilon * (radius2 + std::sqrt(radius2) * (p.lpNorm<1>() + centre.lpNorm<1>()));
  }
  return circles;
}

} // namespace cnem::voronoi
