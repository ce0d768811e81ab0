#pragma once
// Linear statics: small-strain isotropic thermoelasticity, or that of a ply in the plane, on the same
// operators as the explicit solver.
#include "core/fields/state.hpp"
#include "core/geometry/cloud.hpp"
#include "core/operators/discretisation.hpp"
#include "mechanics/supports.hpp"
#include "plasticity/material.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem {

/// In the plane: what is zero out of it, strain or stress. Operators of revolution carry a hoop strain of
/// their own and take strain_free.
enum class OutOfPlane { strain_free, stress_free };

/// K u = f with K = Σ_p V_p Bᵀ D B + the edge-defect stabilisation. Of revolution, forces and energies are
/// those of the whole body: N and J in place of N/m and J/m.
///
/// The columns of `operators` are scalar functions ψ_a, u(x) = Σ_a ψ_a(x) u_a: the shape functions of the
/// nodes, which may be followed by enrichment functions that vanish at the nodes (fracture/enrichment.hpp).
template<int dim> struct StaticProblem {
  const DiscreteOperators<dim>& operators;
  const std::vector<Vec<dim>>& position; ///< [node] m; operators.nodes − position.size() functions enrich
  const StabilisationLinks<dim>& links;  ///< between nodal stress points
  const DiscreteOperators<dim>& link_points; ///< rows of the gradients at the nodes that `links` join
  plasticity::Elasticity elasticity;
  std::span<const plasticity::Elasticity> elasticity_of_point =
      {};                                             ///< [point]; empty: `elasticity` everywhere
  std::optional<plasticity::PlaneStiffness> ply = {}; ///< in the plane, everywhere, instead of elasticity
  OutOfPlane out_of_plane = OutOfPlane::strain_free;
  double stabilisation = 0.05; ///< α of the edge defect, on μ or G12 (the mean of both ends)
  const Supports<dim>& supports;
  double thermal_strain =
      0.0;           ///< – α ΔT, the strain without stress, the same everywhere and in all directions
  double time = 0.0; ///< s, at which prescribed displacements are taken
  const Fields<dim>&
      force; ///< [k][function] N/m, external forces; functions beyond its length are not loaded

  const plasticity::Elasticity& at_point(std::size_t p) const {
    return elasticity_of_point.empty() ? elasticity : elasticity_of_point[p];
  }
  /// Of the edge defect, Pa.
  double shear_modulus(std::size_t p) const { return ply ? ply->shear : at_point(p).mu(); }
};

template<int dim> struct StaticSolution {
  Fields<dim> displacement;          ///< [k][function] m; of nodes first
  Fields<tensor_size<dim>> gradient; ///< [·][point] ∇u, with the strain out of the plane in the place of zz;
                                     ///< with what is thermal
  Fields<symmetric_size<dim>> stress; ///< [·][point] Pa
  Fields<dim> reaction;               ///< [k][node] K u − f at held nodes, N/m^(3−dim); 0 elsewhere
  double strain_energy = 0.0;         ///< J/m^(3−dim) ½ Σ V σ:ε, ε the strain less the thermal one
  double stabilisation_energy = 0.0;  ///< J/m^(3−dim)
  double external_work = 0.0;         ///< J/m^(3−dim) ½ f·u + ½ reactions · prescribed displacements
  double thermal_work = 0.0; ///< J/m^(3−dim) −½ Σ V tr σ α ΔT, of the heat against what holds the body
  double residual = 0.0;     ///< – ‖K u − f‖ of the free unknowns over the largest nodal force norm
  double condition = 0.0;    ///< – of the stiffness scaled to a unit diagonal, estimated
};

/// Solves with a sparse Cholesky factorisation (supernodal where CHOLMOD was found).
/// Throws InputError that names the motion nothing holds when supports leave a rigid body motion free, and
/// DivergenceError that names field and place when what comes out is not a number.
template<int dim> StaticSolution<dim> solve_statics(const StaticProblem<dim>& problem);

} // namespace cnem
