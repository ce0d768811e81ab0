#pragma once
// The tetrahedra inside a boundary, numbered by their nodes.
#include "voronoi/space/walls.hpp"

namespace cnem::voronoi {

struct Filling {
  Tetrahedra tetrahedra;
  bool flipped =
      false; ///< whether there are others than Delaunay's: which ones the numbers of nodes may tell
};

/// Of a cloud whose surface is one and its Delaunay triangulation. Where that lacks facets the cloud is
/// opened (opened.hpp) or the triangulation flipped. Tetrahedra from their lowest node on, in the order of
/// their nodes. O(N log N). Throws GeometryError, naming nodes, as triangulate().
Filling filling(const Cloud<3>& cloud, Delaunay mesh);
/// The same by flips alone, with the walls of the triangulation.
Filling held_filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls);
/// The same of tetrahedra that have all facets, with their walls: `flipped` tells of those that are flat
/// alone.
Filling filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls);
/// Tetrahedra that are those inside already, in the same order.
Tetrahedra in_order(const Cloud<3>& cloud, const Delaunay& inside);

/// Whether a corner is so near the plane of the others that rounding decides on which side.
bool is_flat(const std::array<Vec3, 4>& corner);

} // namespace cnem::voronoi
