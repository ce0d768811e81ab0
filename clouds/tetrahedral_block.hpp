#pragma once
// A block of tetrahedra on a structured grid, and what is bent out of it.
#include "core/geometry/cloud.hpp"

#include <array>
#include <functional>
#include <vector>

namespace cnem::clouds {

/// Nodes and boundary of a block, and the tetrahedra that tile it, right-handed
/// (voronoi/linear_simplices.hpp).
struct TetrahedralBlock {
  Cloud<3> cloud; ///< pieces x-, x+, y-, y+, z-, z+
  std::vector<std::array<NodeIndex, 4>> tetrahedra;
};

/// [0, size] cut into count[0] × count[1] × count[2] boxes of six tetrahedra around a diagonal each (Kuhn),
/// so that faces of neighbours match. `place` moves every node (m → m); it must not turn tetrahedra over.
/// Throws GeometryError for counts below one, for sizes that are not positive, and with its place for a
/// tetrahedron that has no volume.
TetrahedralBlock tetrahedral_block(
    const Vec<3>& size, const std::array<int, 3>& count,
    const std::function<Vec<3>(const Vec<3>&)>& place = [](const Vec<3>& x) { return x; });

/// Takes the square [−1, 1]² to the unit disc, with cells of nearly one size: squares of half-width s go to
/// circles, and their corners are drawn in.
Vec2 disc_of_square(const Vec2& x);

} // namespace cnem::clouds
