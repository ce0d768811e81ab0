#include "clouds/space/generate.hpp"
#include "clouds/space/interior.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cnem::clouds {

namespace {

double angle_between(const Vec3& u, const Vec3& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); }

} // namespace

double least_dihedral(const std::array<Vec3, 4>& x) {
  double least = std::numbers::pi;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) {
      const std::size_t c = a != 0 && b != 0 ? 0 : a != 1 && b != 1 ? 1 : 2;
      const Vec3 edge = x[b] - x[a], u = edge.cross(x[c] - x[a]), v = edge.cross(x[6 - a - b - c] - x[a]);
      least = std::min(least, angle_between(u, v));
    }
  return least;
}

SpaceQuality measure_quality(const Cloud<3>& cloud, const SpaceSpacing& spacing,
                             std::span<const std::array<NodeIndex, 4>> tetrahedra) {
  SpaceQuality quality;
  quality.nearest_min = std::numeric_limits<double>::infinity();
  quality.dihedral_min = quality.facet_angle_min = std::numbers::pi;
  double sum = 0.0, edges = 0.0, flat = 0.0;
  for (const auto& n : tetrahedra) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = cloud.position[n[k]];
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const double ratio = (x[a] - x[b]).norm() / spacing.at(0.5 * (x[a] + x[b]));
        quality.nearest_min = std::min(quality.nearest_min, ratio);
        quality.edge_max = std::max(quality.edge_max, ratio);
        sum += ratio;
        edges += 1.0;
      }
    const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    const double radius =
        (a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b)).norm() /
        (12.0 * measure<3>(x));
    const double dihedral = least_dihedral(x);
    if (dihedral < std::numbers::pi / 18.0)
      flat += 1.0;
    else
      quality.hole_max = std::max(quality.hole_max, radius / spacing.at(0.25 * (x[0] + x[1] + x[2] + x[3])));
    quality.dihedral_min = std::min(quality.dihedral_min, dihedral);
  }
  quality.edge_mean = sum / edges;
  quality.slivers = flat / static_cast<double>(tetrahedra.size());
  for (const Facet<3>& facet : cloud.facets) {
    const auto x = corners_of(facet, cloud.position);
    for (std::size_t k = 0; k < 3; ++k)
      quality.facet_angle_min =
          std::min(quality.facet_angle_min, angle_between(x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]));
  }
  return quality;
}

} // namespace cnem::clouds
