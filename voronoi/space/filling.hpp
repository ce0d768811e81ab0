#pragma once
// The tetrahedra inside a boundary, numbered by their nodes.
#include "voronoi/space/walls.hpp"

#include <optional>

namespace cnem::voronoi {

struct Filling {
  Tetrahedra tetrahedra;
  bool flipped =
      false; ///< whether there are others than Delaunay's: which ones the numbers of nodes may tell
};

/// Of a cloud whose surface is one and its Delaunay triangulation. Where that lacks facets the
/// triangulation is flipped, or the cloud opened where its faces touch and the first flips do not hold all
/// (opened.hpp). Tetrahedra from their lowest node on, in the order of
/// their nodes. O(N log N). Throws GeometryError, naming nodes, as triangulate().
Filling filling(const Cloud<3>& cloud, Delaunay mesh);
/// The same by the first flips that are tried, with the walls of the triangulation; none where more than one
/// facet in 20 is lost, or where that does not hold them all.
std::optional<Filling> filling_at_once(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls);
/// The same by flips alone, in all orders.
Filling held_filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls);
/// The same of tetrahedra that have all facets, with their walls: `flipped` tells of those that are flat
/// alone.
Filling filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls);
/// Tetrahedra that are those inside already, in the same order.
Tetrahedra in_order(const Cloud<3>& cloud, const Delaunay& inside);

/// Whether a corner is so near the plane of the others that rounding decides on which side.
bool is_flat(const std::array<Vec3, 4>& corner);

} // namespace cnem::voronoi
