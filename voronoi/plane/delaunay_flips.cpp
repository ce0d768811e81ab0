#include "voronoi/plane/delaunay_flips.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cnem::voronoi {

namespace {

/// Whether the angles at p and q, on either side of the edge ab, sum to more than π.
bool opposite_angles_too_large(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& q) {
  const Vec2 pa = a - p, pb = b - p, qa = a - q, qb = b - q;
  const double sine_p = cross(pa, pb), cosine_p = pa.dot(pb);
  const double sine_q = cross(qb, qa), cosine_q = qb.dot(qa);
  const double scale = (std::abs(sine_p) + std::abs(cosine_p)) * (std::abs(sine_q) + std::abs(cosine_q));
  return sine_p * cosine_q + cosine_p * sine_q < -1e-10 * scale;
}

std::size_t place_in(const std::array<SimplexIndex, 3>& values, SimplexIndex value) {
  return values[0] == value ? 0 : values[1] == value ? 1 : 2;
}

} // namespace

void restore_delaunay(Triangulation& mesh, const IndexedVector<NodeIndex, Vec2>& position) {
  std::vector<SimplexIndex> waiting;
  waiting.reserve(mesh.node.size());
  for (const SimplexIndex t : mesh.node.indices()) waiting.push_back(t);
  std::reverse(waiting.begin(), waiting.end());
  while (!waiting.empty()) {
    const SimplexIndex t = waiting.back();
    waiting.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const SimplexIndex o = mesh.neighbour[t][k];
      if (!exists(o)) continue;
      const std::size_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const std::size_t m = place_in(mesh.neighbour[o], t), m1 = (m + 1) % 3, m2 = (m + 2) % 3;
      const NodeIndex p = mesh.node[t][k], a = mesh.node[t][k1], b = mesh.node[t][k2];
      const NodeIndex q = mesh.node[o][m];
      if (!opposite_angles_too_large(position[p], position[a], position[b], position[q])) continue;

      // pab and qba become paq and pqb.
      const SimplexIndex beyond_aq = mesh.neighbour[o][m1], beyond_pb = mesh.neighbour[t][k1];
      const std::array<SimplexIndex, 3> t_neighbour{beyond_aq, o, mesh.neighbour[t][k2]};
      const std::array<SimplexIndex, 3> o_neighbour{mesh.neighbour[o][m2], beyond_pb, t};
      const std::array<CloudFacetIndex, 3> t_facet{mesh.facet[o][m1], CloudFacetIndex::none,
                                                   mesh.facet[t][k2]};
      const std::array<CloudFacetIndex, 3> o_facet{mesh.facet[o][m2], mesh.facet[t][k1],
                                                   CloudFacetIndex::none};
      mesh.node[t] = {p, a, q};
      mesh.node[o] = {p, q, b};
      mesh.neighbour[t] = t_neighbour;
      mesh.neighbour[o] = o_neighbour;
      mesh.facet[t] = t_facet;
      mesh.facet[o] = o_facet;
      if (exists(beyond_aq)) {
        auto& back = mesh.neighbour[beyond_aq];
        back[place_in(back, o)] = t;
      }
      if (exists(beyond_pb)) {
        auto& back = mesh.neighbour[beyond_pb];
        back[place_in(back, t)] = o;
      }
      waiting.push_back(o);
      waiting.push_back(t);
      break;
    }
  }
}

} // namespace cnem::voronoi
