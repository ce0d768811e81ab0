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

} // namespace cnem::clouds
