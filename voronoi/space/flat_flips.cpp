#include "voronoi/space/flat_flips.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/exchanges.hpp"
#include "voronoi/space/filling.hpp"

#include <algorithm>
#include <optional>

namespace cnem::voronoi {

namespace {

class Flattened {
public:
  Flattened(const Cloud<3>& cloud, Delaunay& mesh) : cloud_(cloud), exchanges_(cloud, mesh) {}

  void improve(std::vector<SimplexIndex> flat) {
    for (std::size_t n = 0; n < flat.size() && n < 50 * flat.size(); ++n) {
      const FlipMesh::Nodes node = exchanges_.mesh.nodes(flat[n]);
      if (exists(node[0]) && is_flat(corners(node))) improve(node);
    }
    exchanges_.mesh.finish();
  }

private:
  std::array<Vec3, 4> corners(const FlipMesh::Nodes& node) const {
    return {cloud_.position[node[0]], cloud_.position[node[1]], cloud_.position[node[2]],
            cloud_.position[node[3]]};
  }

  /// 6 V/L³ of the worst.
  double quality(const std::vector<FlipMesh::Nodes>& tetrahedra) const {
    double worst = 1.0;
    for (const auto& node : tetrahedra) {
      const std::array<Vec3, 4> x = corners(node);
      double longest = 0.0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (x[a] - x[b]).norm());
      worst = std::min(worst, is_flat(x) ? 0.0 : 6.0 * measure<3>(x) / (longest * longest * longest));
    }
    return worst;
  }

  void improve(const FlipMesh::Nodes& node) {
    std::vector<Exchange> ways;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) exchanges_.add_removals(edge_of(node[a], node[b]), ways);
      const auto& [p, q, r] = face_of_tetrahedron[a];
      exchanges_.add_split(face_of(node[p], node[q], node[r]), ways);
    }
    const Exchange* choice = nullptr;
    double best = 0.0;
    for (const Exchange& way : ways)
      if (const double then = quality(way.fresh); then > best) best = then, choice = &way;
    if (choice) exchanges_.mesh.replace(choice->old, choice->fresh);
  }

  const Cloud<3>& cloud_;
  Exchanges exchanges_;
};

} // namespace

bool exchange_flat(const Cloud<3>& cloud, Delaunay& mesh,
                   const IndexedVector<SimplexIndex, std::uint8_t>& inside) {
  std::vector<SimplexIndex> flat;
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto& node = mesh.node[t];
    if (inside[t] && is_flat({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]],
                              cloud.position[node[3]]}))
      flat.push_back(t);
  }
  if (flat.empty()) return false;
  Flattened(cloud, mesh).improve(flat);
  return true;
}

} // namespace cnem::voronoi
