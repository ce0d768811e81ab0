#include "cnem/space.hpp"

#include "cnem/median.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/space/conduction.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/triangulate.hpp"

#include <fmt/format.h>
#include <utility>

namespace cnem::scni {

CnemInSpace::CnemInSpace(SpaceOptions options) : options_(std::move(options)) {
  if (options_.gauss_points != 1 && options_.gauss_points != 3)
    throw InputError(
        fmt::format("{} Gauss points per facet of a cell: expected 1 or 3", options_.gauss_points));
}

std::string CnemInSpace::name() const {
  if (options_.cells == CellKind::median) return "cnem_median";
  switch (options_.functions) {
  case voronoi::Functions::sibson:
    return "cnem_sibson";
  case voronoi::Functions::laplace:
    return "cnem_laplace";
  case voronoi::Functions::linear:
    break;
  }
  return "cnem_linear";
}

/// What each part alone reads is let go of before the next: beside the approximation that this one follows,
/// all together would hold twice as much.
Approximation<3> CnemInSpace::rebuild(const Cloud<3>& cloud) {
  voronoi::Tetrahedra mesh = options_.tetrahedra.empty() ? voronoi::triangulate(cloud)
                                                         : voronoi::connected(cloud, options_.tetrahedra);
  Approximation<3> result;
  result.conduction =
      voronoi::linear_tetrahedra(cloud, mesh); // before the rest: it takes most while it is made
  voronoi::keep_pattern(result.conduction);
  fallbacks_ = {};
  if (options_.cells == CellKind::median) {
    result.mechanics = median_gradients(cloud, mesh);
    result.links = median_links(cloud, result.mechanics);
    result.cells = voronoi::simplex_geometry<3>(cloud, mesh.node);
  } else {
    auto spheres = voronoi::circumspheres(cloud, mesh);
    voronoi::VoronoiCells cells = voronoi::voronoi_cells(cloud, mesh, spheres);
    cells.edges = {};
    FacetMeans facets =
        facet_means(cloud, mesh, std::move(spheres), cells, options_.functions,
                    options_.gauss_points == 1 ? FacetRule::one_point : FacetRule::one_a_triangle);
    result.cells = voronoi::simplex_geometry<3>(cloud, mesh.node);
    mesh = {};
    cells.points = {};
    cells.rings = {};
    cells.normal = {};
    const auto of_cell = group_by_cell<FaceIndex>(
        cloud.position.size(),
        facets.facet.size(), [&](std::size_t f) -> const auto& { return facets.facet[f].cell; });
    const auto boundary = voronoi::thirds_of_facets(cloud);
    const FacesOfCells<3, Interface<3>> faces{cells.volume, facets.facet, of_cell, boundary,
                                              cells.neighbours};
    result.links = stabilisation_links(cloud, faces);
    result.mechanics = smoothed_gradients(cloud, faces, std::move(facets.means));
    fallbacks_ = facets.fallbacks;
  }
  result.node_volume = result.mechanics.volume;
  result.cells.between_points = true;
  return result;
}

} // namespace cnem::scni
