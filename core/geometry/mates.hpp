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

/// The nodes of one piece of the boundary and those of another that is a shifted copy of it: {first, second},
/// in the order of the first. The shift is the distance of their mean places; partners are within 1e-3 of the
/// shortest edge of the first piece. O(F log F). Throws GeometryError, saying what was found, where the nodes
/// do not match.
template<int dim>
std::vector<std::array<NodeIndex, 2>> shifted_nodes(const Cloud<dim>& cloud,
                                                    const std::array<PieceIndex, 2>& pieces);

/// Pairs of nodes that belong together. In the plane: the nodes at the ends of mates, where the facet that is
/// listed first is of one of the pieces; pairs may come twice, and at a tip a node is its own mate. In space,
/// where facets have no mates: the nodes of the first piece with those of the second, of the third with those
/// of the fourth, and so on. Throws GeometryError as shifted_nodes().
template<int dim>
std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud,
                                                  std::span<const PieceIndex> pieces);
/// All of them; in space none.
template<int dim> std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud);

} // namespace cnem
