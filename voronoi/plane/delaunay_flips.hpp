#pragma once
// Keeps a triangulation Delaunay while its nodes move a little, far cheaper than building a new one.
#include "voronoi/plane/triangulation.hpp"

namespace cnem::voronoi {

/// Flips interior edges until every one is locally Delaunay at `position` (Lawson), to within rounding.
/// Every triangle must be counter-clockwise at `position`. `triangle_of_node` is not kept up to date.
void restore_delaunay(Triangulation& mesh, const IndexedVector<NodeIndex, Vec2>& position);

} // namespace cnem::voronoi
