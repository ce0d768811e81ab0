#include "voronoi/space/surface_fit.hpp"

#include "core/index.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/stars.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cnem::voronoi {

namespace {

/// Edges and faces of the tetrahedra.
class SurfaceFaces {
public:
  explicit SurfaceFaces(const Delaunay& mesh) : first_(mesh.first), stars_(mesh) {}

  /// Whether there is a tetrahedron with them; any of the nodes at one place.
  bool has(NodeIndex a, NodeIndex b, NodeIndex c) {
    a = first_[a], b = first_[b], c = first_[c];
    return a != b && b != c && c != a && exists(stars_.with(a, b, c));
  }
  bool has(NodeIndex a, NodeIndex b) {
    a = first_[a], b = first_[b];
    return a != b && exists(stars_.with(a, b));
  }

private:
  const IndexedVector<NodeIndex, NodeIndex>& first_;
  Stars stars_;
};

} // namespace

int fit_surface(Cloud<3>& cloud, const Delaunay& mesh, const std::vector<CloudFacetIndex>& lost,
                double flat_angle, const FixedNodes& fixed) {
  SurfaceFaces faces(mesh);
  FlippableSurface surface(cloud, fixed);
  const double least_cosine = std::cos(flat_angle);
  std::vector<SurfaceEdge> stack;
  const auto push = [&](CloudFacetIndex f) {
    for (std::size_t k = 0; k < 3; ++k) stack.push_back(edge_at(f, k));
  };
  for (const CloudFacetIndex f : lost) push(f);
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
  const auto is_facet = [](CloudFacetIndex f) { return exists(f); };
  std::optional<FlippableSurface> surface; // few clouds have any
  const double least_cosine = std::cos(flat_angle);
  int flips = 0;
  for (const SimplexIndex t : mesh.node.indices()) {
    if (!walls.blocked[t] || std::count_if(walls.facet[t].begin(), walls.facet[t].end(), is_facet) < 2)
      continue;
    const auto& node = mesh.node[t];
    if (!is_flat({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]],
                  cloud.position[node[3]]}))
      continue;
    if (!surface) surface.emplace(cloud);
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = 0; q < p; ++q) {
        const CloudFacetIndex f = walls.facet[t][p], g = walls.facet[t][q];
        if (!exists(f) || !exists(g)) continue;
        for (std::size_t k = 0; k < 3; ++k)
          if (facet_of(surface->across(edge_at(f, k))) == g && surface->flip(edge_at(f, k), least_cosine)) {
            ++flips;
            p = q = 4;
            break;
          }
      }
  }
  return flips;
}

} // namespace cnem::voronoi
