#pragma once
// The Delaunay triangulation of nodes in space, as plain arrays. CGAL stays behind delaunay.cpp.
#include "core/geometry/cloud.hpp"

#include <array>

namespace cnem::voronoi {

/// Tetrahedra that fill the convex hull.
struct Delaunay {
  IndexedVector<SimplexIndex, std::array<NodeIndex, 4>> node; ///< right-handed; of coincident nodes the first
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 4>>
      neighbour;                               ///< across the face opposite node k; none: convex hull
  IndexedVector<NodeIndex, NodeIndex> first{}; ///< [node] the first node at its place
  bool coincident = false;                     ///< whether there are nodes at the same place
};

/// Predicates are exact, and of cospherical nodes the symbolic perturbation of Devillers and Teillaud (2011)
/// decides, so that the tetrahedra follow from the positions alone. O(N log N). Throws GeometryError, naming
/// nodes with positions, for coincident nodes that are no declared twins and for nodes on one plane.
Delaunay delaunay(const Cloud<3>& cloud);

} // namespace cnem::voronoi
