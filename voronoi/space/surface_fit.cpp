#include "voronoi/space/surface_fit.hpp"

#include "core/index.hpp"
#include "voronoi/space/filling.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::voronoi {

namespace {

/// Edges and faces of the tetrahedra between nodes on the surface.
class SurfaceFaces {
public:
  SurfaceFaces(const Cloud<3>& cloud, const Delaunay& mesh) : first_(mesh.first) {
    IndexedVector<NodeIndex, std::uint8_t> on_surface(cloud.position.size(), 0);
    for (const auto& facet : cloud.facets)
      for (const NodeIndex i : facet.node) on_surface[mesh.first[i]] = 1;
    for (const auto& node : mesh.node) {
      for (const auto& [a, b, c] : face_of_tetrahedron)
        if (on_surface[node[a]] && on_surface[node[b]] && on_surface[node[c]])
          faces_.push_back(sorted({node[a], node[b], node[c]}));
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
          if (on_surface[node[a]] && on_surface[node[b]]) edges_.push_back(std::minmax(node[a], node[b]));
    }
    std::sort(faces_.begin(), faces_.end());
    std::sort(edges_.begin(), edges_.end());
  }

  /// Whether there is a tetrahedron with them; any of the nodes at one place.
  bool has(NodeIndex a, NodeIndex b, NodeIndex c) const {
    return std::binary_search(faces_.begin(), faces_.end(), sorted({first_[a], first_[b], first_[c]}));
  }
  bool has(NodeIndex a, NodeIndex b) const {
    const std::pair<NodeIndex, NodeIndex> edge = std::minmax(first_[a], first_[b]);
    return std::binary_search(edges_.begin(), edges_.end(), edge);
  }

private:
  static std::array<NodeIndex, 3> sorted(std::array<NodeIndex, 3> node) {
    std::sort(node.begin(), node.end());
    return node;
  }
  const IndexedVector<NodeIndex, NodeIndex>& first_;
  std::vector<std::array<NodeIndex, 3>> faces_;
  std::vector<std::pair<NodeIndex, NodeIndex>> edges_;
};

} // namespace

int fit_surface(Cloud<3>& cloud, const Delaunay& mesh, double flat_angle, const FixedNodes& fixed) {
  const SurfaceFaces faces(cloud, mesh);
  FlippableSurface surface(cloud, fixed);
  const double least_cosine = std::cos(flat_angle);
  std::vector<SurfaceEdge> stack;
  const auto push = [&](CloudFacetIndex f) {
    for (std::size_t k = 0; k < 3; ++k) stack.push_back(edge_at(f, k));
  };
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto& [a, b, c] = cloud.facets[f].node;
    if (!faces.has(a, b, c)) push(f);
  }
  int flips = 0;
  while (!stack.empty()) {
    const SurfaceEdge e = stack.back(), back = surface.across(e);
    stack.pop_back();
    const NodeIndex a = surface.start(e), b = surface.start(back), c = surface.apex(e),
                    d = surface.apex(back);
    const int now = faces.has(a, b) + faces.has(a, b, c) + faces.has(a, b, d);
    const int then = faces.has(c, d) + faces.has(c, d, a) + faces.has(c, d, b);
    if (then <= now || !surface.flip(e, least_cosine)) continue;
    ++flips;
    for (const CloudFacetIndex f : {facet_of(e), facet_of(back)}) push(f);
  }
  return flips;
}

int peel_flat(Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls, double flat_angle) {
  FlippableSurface surface(cloud);
  const double least_cosine = std::cos(flat_angle);
  int flips = 0;
  for (const SimplexIndex t : mesh.node.indices()) {
    if (!walls.blocked[t]) continue;
    const auto& node = mesh.node[t];
    if (!is_flat({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]],
                  cloud.position[node[3]]}))
      continue;
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < p; ++q) {
        const CloudFacetIndex f = walls.facet[t][p], g = walls.facet[t][q];
        if (!exists(f) || !exists(g)) continue;
        for (std::size_t k = 0; k < 3; ++k)
          if (facet_of(surface.across(edge_at(f, k))) == g && surface.flip(edge_at(f, k), least_cosine)) {
            ++flips;
            p = q = 4;
            break;
          }
      }
  }
  return flips;
}

} // namespace cnem::voronoi
