#pragma once
// Linear finite-element operators on tetrahedra that may be flat.
#include "core/operators/operators.hpp"
#include "voronoi/space/tetrahedra.hpp"

namespace cnem::voronoi {

/// linear_simplices<3> with one point a tetrahedron, but that flat ones (six times their volume below 0.001
/// of the 3/2nd power of the sum of the squares of their edges, 0.048 if these are equal) are taken together
/// with the neighbour of the largest volume: gradients are means over both, so that they stay finite and the
/// stable step of conduction that of well-shaped tetrahedra. Constants, linear fields and constant fluxes
/// remain exact. Rows of single ones, of four nodes, come before the others. O(N). Throws GeometryError as
/// linear_simplices where one without volume has no larger neighbour.
DiscreteOperators<3> linear_tetrahedra(const Cloud<3>& cloud, const Tetrahedra& mesh);

/// What conduction reads of them (linear_simplices.hpp, keep_pattern), without making the rest. Throws as
/// they do.
DiscreteOperators<3> conduction_pattern(const Cloud<3>& cloud, const Tetrahedra& mesh);

} // namespace cnem::voronoi
