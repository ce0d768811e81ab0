#pragma once
// New triangles for a closed surface, at a wanted spacing. CGAL stays behind remesh.cpp.
#include "core/geometry/cloud.hpp"

namespace cnem::voronoi {

/// Triangles with edges of about h (m) on the surface of `surface`, whose facets' pieces stay apart: edges
/// between them are divided anew along themselves, and their ends and forks stay. Nodes are all new
/// (isotropic remeshing: Botsch, Kobbelt 2004). Expects a closed surface that does not cross itself. O(N log
/// N).
Cloud<3> remesh(const Cloud<3>& surface, double h);

} // namespace cnem::voronoi
