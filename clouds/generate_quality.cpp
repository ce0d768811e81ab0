#include "clouds/generate.hpp"
#include "core/index.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cnem::clouds {

CloudQuality measure_quality(const Cloud<2>& cloud, const SpacingField& spacing) {
  const voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  CloudQuality quality;
  quality.nearest_min = std::numeric_limits<double>::infinity();
  quality.angle_min = std::numbers::pi;
  IndexedVector<NodeIndex, double> length_sum(cloud.position.size(), 0.0),
      valence(cloud.position.size(), 0.0);
  double sum = 0.0, count = 0.0;
  const auto at = [&](NodeIndex i) { return cloud.position[i]; };
  const auto each_edge = [&](auto&& visit) { // each edge once
    for (const SimplexIndex t : mesh.node.indices())
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh.neighbour[t][k] < t) visit(mesh.node[t][(k + 1) % 3], mesh.node[t][(k + 2) % 3]);
  };
  each_edge([&](NodeIndex a, NodeIndex b) {
    const double length = (at(b) - at(a)).norm(), ratio = length / spacing.at(0.5 * (at(a) + at(b)));
    quality.nearest_min = std::min(quality.nearest_min, ratio);
    quality.edge_max = std::max(quality.edge_max, ratio);
    sum += ratio;
    count += 1.0;
    for (const NodeIndex i : {a, b}) {
      length_sum[i] += length;
      valence[i] += 1.0;
    }
  });
  quality.edge_mean = sum / count;
  each_edge([&](NodeIndex a, NodeIndex b) {
    const auto mean = [&](NodeIndex i) { return length_sum[i] / valence[i]; };
    quality.grading_max = std::max({quality.grading_max, mean(a) / mean(b), mean(b) / mean(a)});
  });
  for (const auto& n : mesh.node) {
    const Vec2 b = at(n[1]) - at(n[0]), c = at(n[2]) - at(n[0]);
    const double area2 = cross(b, c);
    const double radius = b.norm() * c.norm() * (b - c).norm() / (2.0 * area2);
    const Vec2 middle = at(n[0]) + (b + c) / 3.0;
    quality.hole_max = std::max(quality.hole_max, radius / spacing.at(middle));
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 u = at(n[(k + 1) % 3]) - at(n[k]), v = at(n[(k + 2) % 3]) - at(n[k]);
      quality.angle_min = std::min(quality.angle_min, std::atan2(cross(u, v), u.dot(v)));
    }
  }
  return quality;
}

} // namespace cnem::clouds
