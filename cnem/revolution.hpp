#pragma once
// What the smoothed gradients of a body of revolution need beside the facets: centroids of the cells and the
// functions there.
#include "core/operators/discretisation.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

namespace cnem::scni {

/// φ_J at the centroids of all cells, as sparse rows.
struct CentroidValues {
  Field radius;                    ///< [cell] r̄ of the centroid, m
  std::vector<std::int32_t> begin; ///< [cell + 1]
  std::vector<NodeIndex> node;
  std::vector<double> value; ///< sums to 1 over a row
};

/// Throws GeometryError when the centroid of a cell is not in the domain.
CentroidValues centroid_values(const Cloud<2>& cloud, const voronoi::Triangulation& triangulation,
                               const voronoi::Circumcircles& circles, const voronoi::Cells& cells,
                               voronoi::Functions functions);

/// Multiplies the weight of each link by 2π times the mean radius of its two cells.
void revolve(const Field& radius, StabilisationLinks<2>& links);

} // namespace cnem::scni
