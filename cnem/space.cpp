#include "cnem/space.hpp"

#include "cnem/median.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/space/conduction.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/triangulate.hpp"

#include <cassert>
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

Approximation<3> CnemInSpace::rebuild(const Cloud<3>& cloud) {
  Approximation<3> result = rebuild_rows(cloud);
  if (result.mechanics.point.empty()) result.mechanics.build_transpose();
  return result;
}

/// What each part alone reads is let go of before the next: beside the approximation that this one follows,
/// all together would hold twice as much.
Approximation<3> CnemInSpace::rebuild_rows(const Cloud<3>& cloud) {
  voronoi::Tetrahedra mesh = options_.tetrahedra.empty() ? voronoi::triangulate(cloud)
                                                         : voronoi::connected(cloud, options_.tetrahedra);
  Approximation<3> result;
  fallbacks_ = {};
  UnjoinedRows<3> rows;
  const bool on_voronoi_cells = options_.cells == CellKind::voronoi;
  if (on_voronoi_cells) {
    rows = rows_on_voronoi_cells(cloud, mesh, result.links);
  } else {
    result.mechanics = median_gradients(cloud, mesh);
    result.links = median_links(cloud, result.mechanics);
  }
  result.conduction = voronoi::conduction_pattern(cloud, mesh);
  result.cells = voronoi::simplex_geometry<3>(cloud, mesh.node);
  result.cells.between_points = true;
  mesh = {};
  if (on_voronoi_cells) {
    result.mechanics = joined(std::move(rows));
    assert(reproduces_linear_fields(result.mechanics, cloud.position));
  }
  result.node_volume = result.mechanics.volume;
  return result;
}

UnjoinedRows<3> CnemInSpace::rows_on_voronoi_cells(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                                   StabilisationLinks<3>& links) {
  const std::size_t nodes = cloud.position.size();
  auto spheres = voronoi::circumspheres(cloud, mesh);
  voronoi::VoronoiCells cells = voronoi::voronoi_cells(cloud, mesh, spheres);
  cells.points.holder = {};
  FacetMeans facets =
      facet_means(cloud, mesh, std::move(spheres), cells, options_.functions,
                  options_.gauss_points == 1 ? FacetRule::one_point : FacetRule::one_a_triangle);
  fallbacks_ = facets.fallbacks;
  cells.points = {};
  auto neighbours = voronoi::neighbours(nodes, cells.rings);
  cells.rings = {};
  const auto of_cell = group_by_cell<FaceIndex>(
      nodes, facets.facet.size(), [&](std::size_t f) -> const auto& { return facets.facet[f].cell; });
  IndexedVector<PartIndex, BoundaryPart<3>> boundary;
  const FacesOfCells<3, Interface<3>> faces{cells.volume, facets.facet, of_cell, boundary, neighbours};
  links = stabilisation_links(cloud, faces);
  neighbours = {};
  boundary = voronoi::thirds_of_facets(cloud);
  return smoothed_rows(cloud, faces, std::move(facets.means));
}

} // namespace cnem::scni
