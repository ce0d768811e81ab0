#pragma once
// Tetrahedra that tile a domain in space, as plain arrays.
#include "core/geometry/cloud.hpp"

#include <array>
#include <span>

namespace cnem::voronoi {

/// Topology is two-sided at walls: tetrahedra on either face of a slit carry that face's own nodes, so
/// nothing that walks over `neighbour` crosses a wall.
struct Tetrahedra {
  IndexedVector<SimplexIndex, std::array<NodeIndex, 4>> node; ///< right-handed, as voronoi::Simplex<3>
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 4>>
      neighbour; ///< [tetrahedron][k] across the face opposite node k; none: boundary
  IndexedVector<SimplexIndex, std::array<CloudFacetIndex, 4>>
      facet;                                      ///< [tetrahedron][k] on that face; none: inside
  IndexedVector<NodeIndex, SimplexIndex> of_node; ///< the first that has it
};

/// Corners of the face opposite corner k, in the order in which its normal points out of the tetrahedron.
inline constexpr std::array<std::array<std::size_t, 3>, 4> face_of_tetrahedron = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// Corners of the edges of a tetrahedron, and the other two in even order.
inline constexpr std::array<std::array<std::size_t, 4>, 6> edges_of_tetrahedron = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

/// Who is whose neighbour among right-handed tetrahedra that tile the domain of a cloud. O(N log N). Throws
/// GeometryError, naming nodes with their positions, where a face belongs to one tetrahedron and is no facet
/// of the cloud, is a facet and belongs to none or to two, or belongs to more than two; and for a node that
/// no tetrahedron has.
Tetrahedra connected(const Cloud<3>& cloud, std::span<const std::array<NodeIndex, 4>> tetrahedra);

} // namespace cnem::voronoi
