#pragma once
// What can be said about a cloud's boundary before (and, for the message, after) it is triangulated.
#include "core/geometry/cloud.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cnem::voronoi {

/// "node 12 at (0.001, 0.002) m".
std::string describe_node(const Cloud<2>& cloud, NodeIndex node);

/// "facet 7 from (0, 0) m to (1, 0) m".
std::string describe_facet(const Cloud<2>& cloud, CloudFacetIndex facet);

/// The facet that leaves each node; none for interior nodes.
/// Throws GeometryError for non-finite positions, twins or facets that name absent nodes, an empty boundary
/// and loops that are open or branch.
IndexedVector<NodeIndex, CloudFacetIndex> outgoing_facets(const Cloud<2>& cloud);

/// Throws the GeometryError that explains why facets cross. O(facets²): for the error path only.
[[noreturn]] void throw_crossing(const Cloud<2>& cloud);

/// Throws the GeometryError that names the node which lies on the facet. O(nodes).
[[noreturn]] void throw_node_on_facet(const Cloud<2>& cloud, CloudFacetIndex facet);

} // namespace cnem::voronoi
