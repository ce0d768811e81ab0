#include "voronoi/space/circumspheres.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cnem::voronoi {

Circumspheres circumspheres(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), flat = 1e-10;
  const std::size_t count = mesh.node.size();
  Circumspheres spheres;
  spheres.centre.resize(count);
  spheres.limit.resize(count);
  std::vector<std::uint8_t> is_flat(count);

  const auto limit = [&](SimplexIndex t, const Vec<3>& corner) {
    const double squared = (corner - spheres.centre[t]).squaredNorm();
    const double size = corner.lpNorm<1>() + spheres.centre[t].lpNorm<1>();
    return squared - 16.0 * epsilon * (squared + std::sqrt(squared) * size);
  };
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto t = as<SimplexIndex>(k);
      const auto& node = mesh.node[t];
      const Vec<3>& origin = cloud.position[node[0]];
      const Vec<3> a = cloud.position[node[1]] - origin, b = cloud.position[node[2]] - origin,
                   c = cloud.position[node[3]] - origin;
      const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
      const Vec<3> bc = b.cross(c);
      const double volume = a.dot(bc);
      is_flat[k] = !(volume * volume > flat * flat * aa * bb * cc);
      if (is_flat[k]) continue;
      spheres.centre[t] = origin + (aa * bc + bb * c.cross(a) + cc * a.cross(b)) * (0.5 / volume);
      spheres.limit[t] = limit(t, origin);
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (!is_flat[k]) continue;
    const auto t = as<SimplexIndex>(k);
    Vec<3> sum = Vec<3>::Zero();
    int known = 0;
    for (const SimplexIndex other : mesh.neighbour[t])
      if (exists(other) && !is_flat[index_of(other)]) {
        sum += spheres.centre[other];
        ++known;
      }
    if (known == 0)
      for (const NodeIndex i : mesh.node[t]) sum += cloud.position[i];
    spheres.centre[t] = sum / (known == 0 ? 4 : known);
    double least = std::numeric_limits<double>::infinity();
    for (const NodeIndex i : mesh.node[t]) least = std::min(least, limit(t, cloud.position[i]));
    spheres.limit[t] = least;
  }
  return spheres;
}

} // namespace cnem::voronoi
