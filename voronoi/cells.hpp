#pragma once
// Constrained Voronoi cells clipped by the domain: the integration cells of the method (paper 004, (70)).
#include "core/aligned.hpp"
#include "core/discretisation.hpp"
#include "voronoi/circumcircles.hpp"
#include "voronoi/triangulation.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// The segment that two cells share, dual to a Delaunay edge.
struct InteriorFacet {
  std::array<std::int32_t, 2> cell;     ///< i, j
  std::array<std::int32_t, 2> triangle; ///< the triangles to both sides of the Delaunay edge, at start and at
                                        ///< end; −1 for start when the edge is a boundary facet
  Vec2 start, end; ///< right_normal(end − start) points from i to j; may coincide (cocircular nodes)
};

/// The part s0 <= s <= s1 of a boundary facet x = (1 − s) x_a + s x_b that bounds a cell, which need not be
/// that of a or b.
struct BoundaryPiece {
  std::int32_t cell;
  std::int32_t facet; ///< index into Cloud::facets
  double s0, s1;
};

/// Cells of all nodes. Each cell is closed: the normals of its facets and pieces sum to zero, and ΣV = |Ω|,
/// whatever the rounding of the vertices.
struct Cells {
  Field volume; ///< [node] m² (per unit thickness)
  std::vector<InteriorFacet> interior;
  std::vector<BoundaryPiece> boundary; ///< facet after facet, along each facet

  /// A point where the facet between two cells ends on the boundary.
  struct Crossing {
    std::int32_t facet;
    double s; ///< along the facet
  };
  /// A triangle whose circumcentre is hidden behind a boundary facet.
  struct Hidden {
    std::int32_t facet; ///< the first wall between the triangle and its circumcentre
    std::array<std::int32_t, 3>
        crossing; ///< [k] where the facet dual to edge k ends on it; −1: it has no end there
  };
  std::vector<Crossing> crossing;
  std::vector<Hidden> hidden;
  std::vector<std::int32_t>
      hidden_of_triangle; ///< [triangle] index into `hidden`; −1: the circumcentre is visible
  std::vector<std::int32_t>
      crossing_of_facet; ///< [cloud facet] where the facet dual to it ends; −1: there is none
};

/// Clips the Voronoi diagram by the domain. O(N).
Cells constrained_cells(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles);

/// The cells as closed polygons whose vertices move with the nodes: circumcentres with the triangle that
/// contains them, ends on the boundary with their facet, boundary nodes with themselves.
CellGeometry<2> cell_geometry(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles,
                              const Cells& cells);

} // namespace cnem::voronoi
