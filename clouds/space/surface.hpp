#pragma once
// Closed surfaces of triangles on bodies in space, at a wanted spacing.
#include "clouds/space/domain.hpp"

namespace cnem::clouds {

/// The surface of a body: a Cloud<3> all of whose nodes are on it, exact on corners, edges and curved faces.
/// Edges where pieces of outlines meet share out ∫ ds/h(x) equally; on arcs, also about the axis, they are
/// chords as in generate_cloud. Faces are made by the plane's generator in coordinates that keep angles, and
/// hence the shape of triangles: faces of extrusions unrolled, those of revolutions as (θ, ∫ ds/r) or, around
/// the poles, as the plane of polar coordinates exp ∫ ds/r and θ, so that circles have nodes in proportion to
/// their radius. O(N log N), about 5 µs a node.
///
/// Throws GeometryError, with positions, as generate_cloud does for outlines, and for extrusions without
/// height, profiles that cross the axis or touch it at a single point, and angles outside (0, 2π].
Cloud<3> extruded_surface(const Extrusion& shape, const SpaceSpacing& spacing);
Cloud<3> revolved_surface(const Revolution& shape, const SpaceSpacing& spacing);

/// The surface that facets describe, with new nodes: edges sharper than the crease angle and those between
/// solids stay, and divide it into pieces. These bear the names of the points nearest to them, else the
/// name of their solid ("surface" without), numbered from the largest on where there are several.
/// One spacing for all. Throws GeometryError, naming facets with positions, for surfaces that are open,
/// branch, turn inside out or cross themselves, facets without area, and refinements.
Cloud<3> remeshed_surface(const Faceted& shape, const SpaceSpacing& spacing);

Cloud<3> surface_of(const SpaceDomain& domain, const SpaceSpacing& spacing);

/// Facets whose normals are that near (rad; 14°) may take the other diagonal, so that it is the Delaunay one.
inline constexpr double flat_angle = 0.2443;

/// m³, of the body as described.
double domain_volume(const SpaceDomain& domain);

/// A length that the body fits into, m.
double domain_size(const SpaceDomain& domain);

} // namespace cnem::clouds
