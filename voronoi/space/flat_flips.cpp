#include "voronoi/space/flat_flips.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/exchanges.hpp"
#include "voronoi/space/filling.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cnem::voronoi {

namespace {

class Flattened {
public:
  Flattened(const Cloud<3>& cloud, Delaunay& mesh)
      : cloud_(cloud), surface_(cloud, mesh.first), exchanges_(cloud, surface_, mesh) {}

  /// A flat one that cannot be exchanged waits until others have been.
  void improve(std::vector<SimplexIndex> flat) {
    bool any = true;
    for (int round = 0; any && round < most_rounds; ++round) {
      any = false;
      std::vector<SimplexIndex> left;
      for (std::size_t n = 0; n < flat.size(); ++n) {
        const FlipMesh::Nodes node = exchanges_.mesh.nodes(flat[n]);
        if (!exists(node[0]) || !is_flat(corners(node))) continue;
        if (!improve(node)) {
          left.push_back(flat[n]);
          continue;
        }
        any = true;
        flat.insert(flat.end(), flat_.begin(), flat_.end());
      }
      flat = std::move(left);
    }
    exchanges_.mesh.finish();
  }

private:
  std::array<Vec3, 4> corners(const FlipMesh::Nodes& node) const {
    return {cloud_.position[node[0]], cloud_.position[node[1]], cloud_.position[node[2]],
            cloud_.position[node[3]]};
  }

  /// How many are flat, and 6 V/L³ of the worst of the others.
  std::pair<int, double> flatness(const std::vector<FlipMesh::Nodes>& tetrahedra) const {
    std::pair<int, double> result{0, 1.0};
    for (const auto& node : tetrahedra) {
      const std::array<Vec3, 4> x = corners(node);
      if (is_flat(x)) {
        int facets = 0;
        for (const auto& [a, b, c] : face_of_tetrahedron)
          facets += surface_.is_facet(face_of(node[a], node[b], node[c]));
        result.first += facets > 1 ? 100 : 1; // between two facets it would stay
        continue;
      }
      double longest = 0.0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (x[a] - x[b]).norm());
      result.second = std::min(result.second, 6.0 * measure<3>(x) / (longest * longest * longest));
    }
    return result;
  }

  /// Makes the exchange that leaves the fewest flat ones, not more than there were, and none twice: what is
  /// left may be exchanged from there. Whether it did.
  bool improve(const FlipMesh::Nodes& node) {
    std::vector<Exchange> ways;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) exchanges_.add_removals(edge_of(node[a], node[b]), ways);
      const auto& [p, q, r] = face_of_tetrahedron[a];
      exchanges_.add_split(face_of(node[p], node[q], node[r]), ways);
    }
    const Exchange* choice = nullptr;
    int fewer = -1;
    double best = 0.0;
    for (const Exchange& way : ways) {
      const auto [flat, worst] = flatness(way.fresh);
      const int gain = flatness(exchanges_.nodes_of(way.old)).first - flat;
      if (gain < std::max(0, fewer) || (gain == fewer && worst <= best)) continue;
      if (gain > 0 || !known_.contains(key_of(way.fresh))) {
        fewer = gain;
        best = worst;
        choice = &way;
      }
    }
    if (!choice) return false;
    known_.insert(key_of(exchanges_.nodes_of(choice->old)));
    known_.insert(key_of(choice->fresh));
    flat_ = exchanges_.mesh.replace(choice->old, choice->fresh);
    return true;
  }

  std::set<std::vector<FlipMesh::Nodes>> known_; ///< what has been there
  std::vector<SimplexIndex> flat_;               ///< made by the last exchange
  static constexpr int most_rounds = 10;
  const Cloud<3>& cloud_;
  SurfaceParts surface_;
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
