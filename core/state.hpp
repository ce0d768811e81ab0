#pragma once
// Everything that evolves in a run, one line per field: unit, meaning, where it lives.
#include "core/aligned.hpp"

#include <cstdint>

namespace cnem {

/// Components of a symmetric tensor: 2D keeps the out-of-plane one: xx, yy, zz, xy; 3D: xx, yy, zz, xy, yz,
/// zx.
template<int dim> inline constexpr int symmetric_size = dim == 2 ? 4 : 6;

/// Components of a general tensor: 2D keeps the out-of-plane one: xx, xy, yx, yy, zz; 3D row by row.
template<int dim> inline constexpr int tensor_size = dim == 2 ? 5 : 9;

/// Fields at nodes. Index: [node], vectors [component][node].
template<int dim> struct NodeState {
  Fields<dim> reference; ///< m      X, position in the reference configuration
  Fields<dim> position;  ///< m      x, position at t_n
  Fields<dim> velocity;  ///< m/s    v at t_{n−½}
  Fields<dim> force;   ///< N/m^(3−dim)   internal and applied forces at t_n, contact and supports excluded
  Field mass;          ///< kg/m^(3−dim)  carried with the node, never recomputed
  Field temperature;   ///< K
  Field heat_capacity; ///< J/(K m^(3−dim))

  std::size_t size() const { return mass.size(); }
};

/// Fields at stress points. Index: [point], tensors [component][point]. Stresses in Pa.
template<int dim> struct PointState {
  Fields<tensor_size<dim>> deformation; ///< –     F, from the reference configuration
  Fields<symmetric_size<dim>>
      elastic; ///< –     C_p⁻¹ = F⁻¹ b_e F⁻ᵀ: elastic left Cauchy-Green, pulled back to the reference
  Fields<tensor_size<dim>> piola; ///< Pa    P, first Piola-Kirchhoff stress on the reference (P_iK)
  Field plastic_strain;           ///< –     ε̄p, equivalent plastic strain
  Field plastic_rate;             ///< 1/s   dε̄p/dt of the last step
  Field equivalent_stress;        ///< Pa    σ_eq, von Mises stress in Kirchhoff measure
  Field pressure;                 ///< Pa    −tr τ/3, Kirchhoff pressure
  Field stored_energy;            ///< J/m³  ψ per unit stress-free volume
  Field plastic_work;             ///< J/m³  ∫ σ_eq dε̄p per unit stress-free volume, since the start
  Field dissipation; ///< J/m³  plastic work of the last step per unit stress-free volume; χ of it is heat
  Field stress_free; ///< –     V_stress-free / V_reference = 1/√det C_p⁻¹, constant between re-references
  Field temperature;                  ///< K     N·T, temperature the material sees
  Field strength;                     ///< –     factor on the flow stress: 1, but for initial imperfections
  std::vector<std::int32_t> material; ///< index of the material
  // Empty unless a material has a damage law:
  Field damage;            ///< –     D, share of the fracture strain used up; 1: softening has begun
  Field softening;         ///< –     ω, share of flow stress and tension lost; 1: broken
  Field initiation_strain; ///< –     ε̄p at which D reached 1, 0 before

  std::size_t size() const { return plastic_strain.size(); }
};

template<int dim> struct State {
  NodeState<dim> node;
  PointState<dim> point;
  double time = 0.0;        ///< s     t_n
  double step_before = 0.0; ///< s     Δt that led to t_n (0 before the first step)
  std::int64_t step = 0;    ///< –     n
};

} // namespace cnem
