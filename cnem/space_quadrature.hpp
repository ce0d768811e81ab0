#pragma once
// Functions integrated over the facets between the Voronoi cells in space, each facet once for its two cells.
#include "cnem/quadrature.hpp"
#include "cnem/smoothing.hpp"
#include "voronoi/space/natural_neighbours.hpp"
#include "voronoi/space/voronoi_cells.hpp"

#include <vector>

namespace cnem::scni {

/// Surfaces between cells and the means of functions on them.
struct FacetMeans {
  std::vector<Interface<3>> facet; ///< facets, or their triangles
  FaceMeans means;                 ///< on those
  voronoi::Fallbacks fallbacks;    ///< of the points
};

/// Points on each facet that is plane: one, its centroid, or one a triangle that it is divided into from
/// there. A facet that is not plane, as where a wall hides a circumcentre, is integrated triangle by triangle
/// of its fan, else linear fields would not be reproduced. Facets whose area is less than 1e-14 of the
/// squared distance of their nodes are left out: they carry rounding only. O(N).
enum class FacetRule { one_point, one_a_triangle };
FacetMeans facet_means(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh, voronoi::Circumspheres spheres,
                       const voronoi::VoronoiCells& cells, voronoi::Functions functions, FacetRule rule);

} // namespace cnem::scni
