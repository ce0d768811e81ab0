#pragma once
// Constrained Voronoi cells clipped by the domain: the integration cells of the method (paper 004, (70)).
#include "core/geometry/cell_complex.hpp"
#include "core/operators/discretisation.hpp"
#include "voronoi/plane/circumcircles.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// Cells of all nodes with the way walls cut them, ΣV = |Ω| and each closed, whatever the rounding of the
/// vertices. An inner face is dual to a Delaunay edge; its `simplex` are the triangles to both sides of the
/// edge, at its first corner and at its second. Parts of the boundary stand along each facet. Linked are the
/// ends of Delaunay edges, those whose face a wall cuts away entirely too.
struct Cells : CellComplex<2> {
  /// A point where the facet between two cells ends on the boundary.
  struct Crossing {
    CloudFacetIndex facet;
    double s; ///< along the facet
  };
  /// A triangle whose circumcentre is hidden behind a boundary facet.
  struct Hidden {
    CloudFacetIndex facet; ///< the first wall between the triangle and its circumcentre
    std::array<std::int32_t, 3>
        crossing; ///< [k] where the facet dual to edge k ends on it; −1: it has no end there
  };
  std::vector<Crossing> crossing;
  std::vector<Hidden> hidden;
  IndexedVector<SimplexIndex, std::int32_t>
      hidden_of_triangle; ///< index into `hidden`; −1: the circumcentre is visible
  IndexedVector<CloudFacetIndex, std::int32_t>
      crossing_of_facet; ///< where the facet dual to it ends; −1: there is none
};

/// Clips the Voronoi diagram by the domain. O(N).
Cells constrained_cells(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles);

/// The cells as closed polygons whose vertices move with the nodes: circumcentres with the triangle that
/// contains them, ends on the boundary with their facet, boundary nodes with themselves.
CellGeometry<2> cell_geometry(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles,
                              const Cells& cells);

} // namespace cnem::voronoi
