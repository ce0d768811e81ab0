#pragma once
// The order of triangles as a function of the triangles alone, whoever made them and in whatever order.
#include "voronoi/plane/triangulation.hpp"

namespace cnem::voronoi {

using TriangleNodes = std::array<NodeIndex, 3>;

/// Each triangle from its lowest node on, the list by first and second node: which belong to one triangle
/// only. triangle_of_node becomes the first triangle of each node, of boundary nodes that beside the facet
/// which leaves them; none for nodes without a triangle. O(triangles).
void number_by_nodes(Triangulation& mesh, std::size_t nodes);

} // namespace cnem::voronoi
