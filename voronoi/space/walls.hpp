#pragma once
// Where the facets of a cloud stand among its Delaunay tetrahedra, and the tetrahedra that lie inside.
#include "voronoi/space/delaunay.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <cstdint>
#include <vector>

namespace cnem::voronoi {

struct Walls {
  IndexedVector<SimplexIndex, std::array<CloudFacetIndex, 4>>
      facet; ///< [tetrahedron][k] the facet on that face which has it on its inner side; none: none has
  IndexedVector<SimplexIndex, std::uint8_t> blocked; ///< bit k: there is a facet on that face, of either side
  std::vector<CloudFacetIndex> lost;                 ///< facets that are no face of a tetrahedron
  std::vector<CloudFacetIndex> beyond; ///< facets with nothing on their inner side: at the convex hull
};

/// O(tetrahedra).
Walls find_walls(const Cloud<3>& cloud, const Delaunay& mesh);

/// [tetrahedron] whether it is reached from the inner sides of facets without passing one.
/// Throws GeometryError, naming nodes, where that reaches the outer side of a facet: inside out.
IndexedVector<SimplexIndex, std::uint8_t> inside_of_walls(const Cloud<3>& cloud, const Delaunay& mesh,
                                                          const Walls& walls);

/// [tetrahedron] its nodes, where several nodes stand at one place those of the side of the facets that it is
/// on. Throws GeometryError where the surface touches itself.
IndexedVector<SimplexIndex, std::array<NodeIndex, 4>>
own_nodes(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
          const IndexedVector<SimplexIndex, std::uint8_t>& inside);

} // namespace cnem::voronoi
