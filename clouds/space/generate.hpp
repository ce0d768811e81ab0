#pragma once
// Clouds in space from a described body: the surface at the wanted spacing, and nodes inside.
#include "clouds/space/domain.hpp"

#include <array>
#include <span>
#include <string>

namespace cnem::clouds {

struct GeneratedSpaceCloud {
  Cloud<3> cloud;
  std::vector<std::string> warnings; ///< what the spacing hardly resolves, one sentence each
};

/// Nodes and surface for a body: distances of neighbours are about h(x), also on the surface, and no node
/// inside stands in the diametral ball of a facet. Inside, a body-centred lattice (uniform spacing) or a
/// front that grows from the surface (graded), smoothed; nodes are in space-filling order. A function of its
/// arguments alone. periods: names of pieces of which the second becomes a shifted copy of the first, node by
/// node. Throws GeometryError, with positions, as extruded_surface, revolved_surface, remeshed_surface and
/// repeat_piece, and a SpacingError with the estimate for more than `nodes_limit` nodes. About 40 µs a node
/// with a uniform spacing, 90 µs graded.
GeneratedSpaceCloud generate_cloud(const SpaceDomain& domain, const SpaceSpacing& spacing,
                                   double nodes_limit = 5.0e6,
                                   std::span<const std::array<std::string, 2>> periods = {});

/// Number of nodes that generate_cloud would make, within about 15%, in milliseconds to a second; counting
/// stops above `limit`.
double estimate_nodes(const SpaceDomain& domain, const SpaceSpacing& spacing, double limit = 5.0e6);

/// How well a cloud follows a spacing field, and of what shape its Delaunay tetrahedra are.
struct SpaceQuality {
  double nearest_min = 0.0;     ///< shortest edge over h at its middle
  double edge_max = 0.0;        ///< longest edge over h at its middle
  double edge_mean = 0.0;       ///< mean edge over h
  double hole_max = 0.0;        ///< largest circumradius over h; 0.65 in the lattice
  double dihedral_min = 0.0;    ///< rad
  double slivers = 0.0;         ///< fraction of tetrahedra with a dihedral angle below 10°
  double facet_angle_min = 0.0; ///< smallest angle of a facet, rad
};

/// Quality over right-handed tetrahedra that fill the cloud.
SpaceQuality measure_quality(const Cloud<3>& cloud, const SpaceSpacing& spacing,
                             std::span<const std::array<NodeIndex, 4>> tetrahedra);

} // namespace cnem::clouds
