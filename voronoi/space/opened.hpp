#pragma once
// Tetrahedra of a body whose faces touch each other.
#include "voronoi/space/filling.hpp"

#include <optional>
#include <vector>

namespace cnem::voronoi {

/// The tetrahedra of a body that touches itself. Across a gap of nothing all facets have nodes of the other
/// face in their balls, and flips of tetrahedra find no way past these. So the faces are set apart first, by
/// 0.4 of the length of their edges, with what lies behind them; the tetrahedra that hold the facets then do
/// so at the true places, too. What would cross or lose its volume on the way stays where it is.
///
/// None where its faces do not touch (faces_touch()), or where that does not give right-handed tetrahedra at
/// the true places. Expects a surface that surface_edges() takes. O(N log N).
std::optional<Filling> filling_of_opened(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost);

/// Whether a node of the facets that the Delaunay triangulation has lost is nearer than a twentieth of an
/// edge to a face that looks at it; not where the cloud has twins. O(N log N).
bool faces_touch(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost);

} // namespace cnem::voronoi
