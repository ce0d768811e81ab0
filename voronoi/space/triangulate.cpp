#include "voronoi/space/triangulate.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/space/filling.hpp"
#include "voronoi/space/surface.hpp"
#include "voronoi/space/walls.hpp"

#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

[[noreturn]] void throw_lost(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost) {
  refuse_crossings(cloud, lost);
  throw GeometryError(fmt::format("{} of {} facets are no faces of Delaunay tetrahedra, the first {}: the "
                                  "boundary has to be recovered first",
                                  lost.size(), cloud.facets.size(), describe_facet(cloud, lost.front())));
}

} // namespace

Tetrahedra triangulate(const Cloud<3>& cloud) {
  surface_edges(cloud);
  const Delaunay mesh = delaunay(cloud);
  const Walls walls = find_walls(cloud, mesh);
  if (!walls.lost.empty()) throw_lost(cloud, walls.lost);
  const auto inside = inside_of_walls(cloud, mesh, walls);
  return filling(cloud, mesh, walls, inside);
}

} // namespace cnem::voronoi
