#pragma once
// Deformation gradient at stress points and forces at nodes: the two products with the gradient operator.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "core/operators/side_by_side.hpp"

namespace cnem {

/// F_p = Σ_J x_J ⊗ b_pJ for the points [begin, end) (paper 004, (75); Box 2 (i)). `position` side by side;
/// `deformation` as in PointState; its out-of-plane component in 2D is Σ_J h_pJ r_J in a body of revolution,
/// else left as it is (1 in plane strain).
template<int dim>
void deformation_gradient(const DiscreteOperators<dim>& operators, const Field& position,
                          Fields<tensor_size<dim>>& deformation, std::size_t begin, std::size_t end);

/// value_p = Σ_J N_pJ value_J for the points [begin, end).
template<int dim>
void interpolate(const DiscreteOperators<dim>& operators, const Field& nodal, Field& at_points,
                 std::size_t begin, std::size_t end);

/// Mean at node J of a field of stress points, weighted by the volume each shares with it; the field itself
/// for nodal operators.
template<int dim>
double average_at_node(const DiscreteOperators<dim>& operators, const Field& at_points, NodeIndex node);
template<int dim> Field average_at_nodes(const DiscreteOperators<dim>& operators, const Field& at_points);

/// Stresses as forces are made from them.
template<int dim> struct ColumnStress {
  Field columns;      ///< [point][k] P_ik side by side, Pa
  Field out_of_plane; ///< [point] in the plane: P_zz, Pa
};

/// Takes the stresses of all points.
template<int dim> void copy_stress_columns(const Fields<tensor_size<dim>>& piola, ColumnStress<dim>& stress);

/// force_J −= Σ_p V_p (P_p b_pJ + P_θθ h_pJ e_r) for the nodes [begin, end): minus the internal force (52),
/// gathered.
template<int dim>
void subtract_internal_force(const DiscreteOperators<dim>& operators, const ColumnStress<dim>& stress,
                             Fields<dim>& force, std::size_t begin, std::size_t end);

/// b_e = F C_p⁻¹ Fᵀ in place of C_p⁻¹, and F F₀ in place of F₀: the elastic state, and the axes of the
/// material, on a reference that is the present configuration.
template<int dim> void push_forward(PointState<dim>& point);

/// Components of det F · F⁻ᵀ at a point, laid as in PointState.
template<int dim>
std::array<double, tensor_size<dim>> cofactors(const Fields<tensor_size<dim>>& deformation, std::size_t p);

/// det F of one point.
template<int dim> double jacobian(const Fields<tensor_size<dim>>& deformation, std::size_t p);

} // namespace cnem
