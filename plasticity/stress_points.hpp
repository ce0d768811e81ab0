#pragma once
// What the return map reads and writes, as plain pointers: this header is also seen by the kernels that are
// compiled once per instruction set, so it holds no functions and no standard containers.
#include "plasticity/ply_points.hpp"

#include <cstddef>

namespace cnem::plasticity {

/// Pointers to the fields of stress points, indexed [point]; tensor components as in core/fields/state.hpp:
/// general 2D xx, xy, yx, yy, zz, 3D row by row; symmetric 2D xx, yy, zz, xy, 3D xx, yy, zz, xy, yz, zx. No
/// alignment or padding is needed.
template<int dim> struct StressPoints {
  static constexpr int general = dim == 2 ? 5 : 9;
  static constexpr int symmetric = dim == 2 ? 4 : 6;

  // in
  const double* deformation[general]; ///< –     F_{n+1} from the current reference
  const double* temperature;          ///< K
  const double* strength;             ///< –     factor on the flow stress
  /// –     of the current reference since the start; null where no material is anisotropic
  const double* earlier_deformation[general];
  // in and out
  double* inverse_plastic_cauchy_green[symmetric]; ///< –     C_p⁻¹, so that b_e = F C_p⁻¹ Fᵀ; changes in
                                                   ///< plastic steps only
  double* plastic_strain;    ///< –     ε̄p
  double* plastic_rate;      ///< 1/s   mean dε̄p/dt of the step; in: that of the last step, starts Newton
  double* equivalent_stress; ///< Pa    σ̄ of τ, von Mises' or Hill's; in: that of t_n, for the trapezoid of
                             ///< the work
  double* plastic_work; ///< J/m³  ∫ σ_eq dε̄p per unit stress-free volume
  // out
  double* piola[general]; ///< Pa    P_iK = (τ F⁻ᵀ)_iK V_stress-free/V_reference
  double* pressure;       ///< Pa    −tr τ/3
  double* stored_energy;  ///< J/m³  ψ per unit stress-free volume
  double* dissipation;    ///< J/m³  plastic work of this step per unit stress-free volume; χ of it is heat
  double* stress_free;    ///< –     V_stress-free/V_reference = 1/√det C_p⁻¹
  // of some analyses and materials alone, which kernels do not see
  double* thickness; ///< –     of plane stress, present over initial; in: that of t_n; null: no such analysis
  const double* softening; ///< –     ω at t_n; null: no material has a damage law
  PlyPoints ply;
};

} // namespace cnem::plasticity
