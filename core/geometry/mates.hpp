#pragma once
// Facets that belong together: the two faces of an interface or of a closed crack, the two sides of a period.
#include "core/geometry/cloud.hpp"

#include <array>
#include <span>
#include <vector>

namespace cnem {

/// Pairs all facets that lie on each other node by node, to the bit (Cloud::mates). O(F log F).
void pair_coincident_facets(Cloud<2>& cloud);

/// Pairs the facets whose ends are {one, other} of `nodes`, in either order. O(F log F).
void pair_facets(Cloud<2>& cloud, std::span<const std::array<NodeIndex, 2>> nodes);

/// The pairs of nodes at the ends of mates, where the facet that is listed first is of one of the pieces:
/// pairs may come twice, and at a tip a node is its own mate. Only the plane has mates.
template<int dim>
std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud,
                                                  std::span<const PieceIndex> pieces);
/// All of them.
template<int dim> std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud);

} // namespace cnem
