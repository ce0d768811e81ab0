#include "voronoi/delaunay_flips.hpp"

#include "core/index.hpp"

#include <cmath>
#include <numeric>

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

std::size_t place_in(const std::array<std::int32_t, 3>& values, std::int32_t value) {
  return values[0] == value ? 0 : values[1] == value ? 1 : 2;
}

} // namespace

void restore_delaunay(Triangulation& mesh, const IndexedVector<NodeIndex, Vec2>& position) {
  std::vector<std::int32_t> waiting(mesh.node.size());
  std::iota(waiting.rbegin(), waiting.rend(), 0);
  while (!waiting.empty()) {
    const std::int32_t t = waiting.back();
    waiting.pop_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t o = mesh.neighbour[index_of(t)][k];
      if (o < 0) continue;
      const std::size_t k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const std::size_t m = place_in(mesh.neighbour[index_of(o)], t), m1 = (m + 1) % 3, m2 = (m + 2) % 3;
      const NodeIndex p = mesh.node[index_of(t)][k], a = mesh.node[index_of(t)][k1],
                      b = mesh.node[index_of(t)][k2];
      const NodeIndex q = mesh.node[index_of(o)][m];
      if (!opposite_angles_too_large(position[p], position[a], position[b], position[q])) continue;

      // pab and qba become paq and pqb.
      const std::int32_t beyond_aq = mesh.neighbour[index_of(o)][m1],
                         beyond_pb = mesh.neighbour[index_of(t)][k1];
      const std::array<std::int32_t, 3> t_neighbour{beyond_aq, o, mesh.neighbour[index_of(t)][k2]};
      const std::array<std::int32_t, 3> o_neighbour{mesh.neighbour[index_of(o)][m2], beyond_pb, t};
      const std::array<std::int32_t, 3> t_facet{mesh.facet[index_of(o)][m1], -1, mesh.facet[index_of(t)][k2]};
      const std::array<std::int32_t, 3> o_facet{mesh.facet[index_of(o)][m2], mesh.facet[index_of(t)][k1], -1};
      mesh.node[index_of(t)] = {p, a, q};
      mesh.node[index_of(o)] = {p, q, b};
      mesh.neighbour[index_of(t)] = t_neighbour;
      mesh.neighbour[index_of(o)] = o_neighbour;
      mesh.facet[index_of(t)] = t_facet;
      mesh.facet[index_of(o)] = o_facet;
      if (beyond_aq >= 0) {
        auto& back = mesh.neighbour[index_of(beyond_aq)];
        back[place_in(back, o)] = t;
      }
      if (beyond_pb >= 0) {
        auto& back = mesh.neighbour[index_of(beyond_pb)];
        back[place_in(back, t)] = o;
      }
      waiting.push_back(o);
      waiting.push_back(t);
      break;
    }
  }
}

} // namespace cnem::voronoi
