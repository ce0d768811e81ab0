#include "clouds/generate_interior.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cstdlib>

namespace cnem::clouds {

Necks find_necks(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  IndexedVector<NodeIndex, std::int32_t> loop(cloud.position.size(), -1), place(cloud.position.size(), -1);
  std::vector<std::int32_t> loop_size;
  for (const Facet<2>& f : cloud.facets) { // they come loop after loop
    if (loop[f.node[0]] < 0) loop_size.push_back(0);
    const auto current = static_cast<std::int32_t>(loop_size.size()) - 1;
    for (const NodeIndex i : f.node) loop[i] = current;
    place[f.node[0]] = loop_size.back()++;
  }
  constexpr std::int32_t near = 8; // facets: across a corner, even an acute one, is no neck
  Necks necks;
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
      if (mesh.neighbour[t][k] < t || place[a] < 0 || place[b] < 0) continue;
      if (loop[a] == loop[b]) {
        const std::int32_t apart = std::abs(place[a] - place[b]);
        if (std::min(apart, loop_size[index_of(loop[a])] - apart) <= near) continue;
      }
      const double width = (cloud.position[a] - cloud.position[b]).norm();
      if (necks.pairs++ > 0 && width >= necks.width) continue;
      necks.width = width;
      necks.where = 0.5 * (cloud.position[a] + cloud.position[b]);
    }
  return necks;
}

} // namespace cnem::clouds
