#pragma once
// The planes of a boundary in space, on which nodes that move have to stay.
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/cloud.hpp"

#include <span>

namespace cnem::adapt {

/// What of a way leaves a place on planes with these unit normals: all of it, or the part along one plane or
/// along the line in which they meet; nothing where they meet in a point. Normals that are less than 1e-6 rad
/// apart are those of one plane.
Vec3 within_planes(std::span<const Vec3> normals, const Vec3& way);

/// Which facets count as parts of planes.
enum class Plane {
  beside, ///< another of their piece beside them has the same normal to rounding
  piece,  ///< all of their piece have; the halves of a facet that was split do not make a plane
};

/// Which facets of a body are parts of planes. Facets of curved pieces are none. Keeps what it needs of the
/// cloud as it is now. O(F log F). Throws GeometryError as voronoi::surface_edges() does.
class BoundaryPlanes {
public:
  explicit BoundaryPlanes(const Cloud<3>& cloud, Plane plane = Plane::beside);

  /// What of a way leaves a node on the planes that its facets are of.
  Vec3 keep(NodeIndex node, const Vec3& way) const { return keep(around_.of(node), way); }
  /// The same for the planes of some facets.
  Vec3 keep(std::span<const CloudFacetIndex> facets, const Vec3& way) const;

  /// [node] its facets.
  std::span<const CloudFacetIndex> around(NodeIndex node) const { return around_.of(node); }

private:
  CellLists<CloudFacetIndex> around_;
  IndexedVector<CloudFacetIndex, Vec3> plane_; ///< normal; 0 of a facet that is of no plane
};

} // namespace cnem::adapt
