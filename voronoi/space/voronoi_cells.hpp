#pragma once
// Constrained Voronoi cells of the nodes of a cloud in space.
#include "core/geometry/cell_complex.hpp"
#include "voronoi/space/dual_points.hpp"

namespace cnem::voronoi {

/// Between the cells of the ends of an edge stands its facet: the fan of triangles from the middle of the
/// edge to the dual points round it. With the parts of the boundary facets (thirds_of_facets: from a corner
/// over the middle of an edge to the dual point) they close every cell wherever the dual points are, and as
/// these parts and all fans but those of the own edges lie in planes through the node,
///   V_i = Σ_edges of i ⅙ N_ij·(x_j − x_i),
/// N the area vector of the fan. Σ V is the volume of the body.
struct VoronoiCells {
  DualPoints points;
  EdgeRings rings;
  Field volume; ///< [cell] m³
};

/// N of an edge, from its first end to its second, m².
Vec<3> facet_normal(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge);

/// The other ends of the edges of each cell. An edge that has several rings counts once.
CellLists<NodeIndex> neighbours(std::size_t cells, const EdgeRings& rings);

/// Dual points of cells with less than 0.15 of their share in the tetrahedra (a quarter of each) are drawn to
/// the centroids, by half at a time, until there is none: circumcentres alone leave negative volumes where
/// tetrahedra are far from Delaunay, as after shear. O(N). Throws GeometryError, with its place, for a node
/// whose tetrahedra have no volume.
VoronoiCells voronoi_cells(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres);

/// The polygon of dual points round an edge, m: with the middle of the edge where its ring is open.
void facet_polygon(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge,
                   std::vector<Vec<3>>& polygon);

/// With the triangles of all fans as inner faces.
CellComplex<3> cell_complex(const Cloud<3>& cloud, const Tetrahedra& mesh, const VoronoiCells& cells);

} // namespace cnem::voronoi
