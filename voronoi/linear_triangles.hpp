#pragma once
// Linear finite-element operators on the constrained Delaunay triangles. They are a discretisation of their
// own (methods/fe_triangle) and the operators C-NEM conducts heat with: GᵀV k G of nodal integration
// lets checkerboards of temperature stand, the triangles do not.
#include "core/operators.hpp"
#include "core/revolution.hpp"
#include "voronoi/triangulation.hpp"

namespace cnem::voronoi {

/// One stress point per triangle, V = its area (m²), b = the constant gradients of the linear shape functions
/// (1/m), N = 1/3 each; of revolution V = 2π r̄ A and h = N/r̄. Rows are sorted by node; the transpose is
/// built. Throws GeometryError, with the corners' positions, when a triangle has no area in floating point.
DiscreteOperators<2> linear_triangles(const Cloud<2>& cloud, const Triangulation& triangulation,
                                      Space space = Space::plane);

} // namespace cnem::voronoi
