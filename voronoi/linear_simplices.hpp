#pragma once
// Linear finite-element operators on simplices: triangles in the plane, tetrahedra in space. They are a
// discretisation of their own (methods/fe_simplices), and on the constrained Delaunay triangles the operators
// C-NEM conducts heat with: GᵀV k G of nodal integration lets checkerboards of temperature stand, the
// triangles do not.
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/operators/discretisation.hpp"

#include <array>
#include <span>

namespace cnem::voronoi {

/// Corners of a simplex: triangles counter-clockwise; of tetrahedra the first three clockwise as seen from
/// the fourth, so that (x₁ − x₀, x₂ − x₀, x₃ − x₀) is right-handed.
template<int dim> using Simplex = std::array<NodeIndex, dim + 1>;

/// One stress point per simplex, V = its measure (m² or m³), b = the constant gradients of the linear shape
/// functions (1/m), N = 1/(dim + 1) each; of revolution V = 2π r̄ A and h = N/r̄. Rows are sorted by node; the
/// transpose is built. Throws GeometryError, with the corners' positions, when a simplex has no measure in
/// floating point.
template<int dim>
DiscreteOperators<dim> linear_simplices(const Cloud<dim>& cloud, std::span<const Simplex<dim>> simplices,
                                        Space space = Space::plane);

/// Lets go of what conduction does not read of tetrahedra, which conduct as they stand
/// (thermal/conduction.hpp) and would take as much memory as the operators of mechanics: their pattern is
/// left, and the gradients of other rows that follow theirs (voronoi/space/conduction.hpp) alone.
void keep_pattern(DiscreteOperators<3>& op);

/// Simplices as they are drawn, whose vertices are the nodes.
template<int dim>
CellGeometry<dim> simplex_geometry(const Cloud<dim>& cloud, std::span<const Simplex<dim>> simplices);

} // namespace cnem::voronoi
