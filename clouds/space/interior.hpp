#pragma once
// Nodes inside a closed surface: lattices, growing fronts, smoothing.
#include "clouds/space/domain.hpp"
#include "clouds/space/facet_tree.hpp"

namespace cnem::clouds {

/// Nodes may stand where they are this far (over h) inside the surface and in no facet's diametral ball,
/// so that facets are Delaunay.
struct Room {
  const FacetTree& tree;
  double clearance = 0.5;

  bool free(const Vec3& x, double h) const;
};

/// Body-centred cubic nodes with nearest distance h, 1.3 h⁻³ a volume, symmetric in the bounding box: its
/// tetrahedra are all alike, with angles of 60° and 90°, and no five nodes are on a sphere without another
/// inside.
std::vector<Vec3> lattice_nodes(const Cloud<3>& surface, const Room& room, double h);

/// Nodes at distances of about h(x) from each other and from those of the surface, placed by a front that
/// grows inwards. O(N).
std::vector<Vec3> front_nodes(const Cloud<3>& surface, const Room& room, const SpaceSpacing& spacing);

/// Moves nodes towards the volume-weighted mean of the circumcentres of their tetrahedra (optimal Delaunay
/// triangulation: Chen 2004) with weight h⁻⁵, fills holes, thins crowds, and takes nodes of flat tetrahedra
/// to where these are less so. With a uniform spacing only nodes near the surface are touched.
void smooth_nodes(const Cloud<3>& surface, const Room& room, const SpaceSpacing& spacing,
                  std::vector<Vec3>& interior);

/// The smallest angle between two faces of a tetrahedron, rad.
double least_dihedral(const std::array<Vec3, 4>& corner);

} // namespace cnem::clouds
