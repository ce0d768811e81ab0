#pragma once
// Makes the boundary of a cloud in space one that the Delaunay triangulation of its nodes holds.
#include "core/geometry/cloud.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

struct RecoveryRules {
  double flat_angle = 0.2443; ///< rad (14°): facets of one piece whose normals are that near may be flipped
  double smooth_angle =
      0.7;            ///< rad (40°): the same for facets that nothing else brings back; creases are sharper
  bool sound = false; ///< whether the facets are known not to cross each other
};

/// What a recovery has done.
struct RecoveryCounts {
  int lost = 0;     ///< facets that the Delaunay triangulation did not have after Lawson's flips
  int flipped = 0;  ///< edges of the surface that became the other diagonal
  int held = 0;     ///< lost facets for which tetrahedra were flipped
  int removed = 0;  ///< inner nodes in diametral balls of lost facets
  int replaced = 0; ///< facets that came with the boundary of the tetrahedra inside
};

struct RecoveredBoundary {
  Cloud<3> cloud;
  Tetrahedra tetrahedra;
  IndexedVector<NodeIndex, NodeIndex> now; ///< [node of the old cloud] its number; none: it is gone
  RecoveryCounts counts;
  bool flipped = false; ///< whether there are others than Delaunay's among the tetrahedra (filling.hpp)
};

/// The cheapest first: (1) Lawson's flips of the surface within named pieces; then, where faces touch, these
/// are set apart (opened.hpp), else flips to diagonals that the tetrahedra have, such that none that is flat
/// to rounding lies on the inner side of two facets; (2) flips of tetrahedra (facet_flips.hpp), which change
/// neither nodes nor surface; (3) flips of the surface at larger angles; (4) inner nodes in diametral balls
/// of lost facets go; (5) the boundary of the tetrahedra inside becomes the surface, if it is a manifold with
/// the same nodes, where tetrahedra that are flat on a face count as outside and new facets inherit their
/// piece. Nodes keep their places and their order, creases between pieces stay but for (5). Flips after which
/// facets cross each other are done on planes alone. triangulate() of the new cloud gives the tetrahedra.
/// Bodies (Cloud::body) are recovered each for itself, and may overlap: facets stand body after body then.
/// O(N log N). Throws GeometryError as triangulate(), and where nothing helps, naming a facet that is lost.
RecoveredBoundary recover_boundary(const Cloud<3>& cloud, const RecoveryRules& rules = {});

} // namespace cnem::voronoi
