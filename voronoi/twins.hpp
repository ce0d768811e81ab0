#pragma once
// Nodes that coincide on purpose, in the plane and in space.
#include "core/geometry/cloud.hpp"

#include <string>

namespace cnem::voronoi {

/// Throws GeometryError unless the cloud has the node that `who` names.
template<int dim> void check_node_index(const Cloud<dim>& cloud, NodeIndex node, const std::string& who);

/// Union of the declared twins: two nodes may coincide when their groups are the same. Empty without twins.
/// Throws GeometryError for twins that name absent nodes.
template<int dim> IndexedVector<NodeIndex, NodeIndex> twin_groups(const Cloud<dim>& cloud);

} // namespace cnem::voronoi
