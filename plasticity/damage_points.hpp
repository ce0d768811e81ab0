#pragma once
// What the damage pass reads and writes, and its entry points, one per instruction set. No function
// definitions and no standard containers here (see plasticity/stress_points.hpp).
#include <cstddef>

namespace cnem::plasticity {

/// Pointers to the fields of stress points, indexed [point]; tensor components as in core/state.hpp.
template<int dim> struct DamagePoints {
  static constexpr int general = dim == 2 ? 5 : 9;

  // in
  const double* deformation[general]; ///< –     F_{n+1}
  const double* temperature;          ///< K
  const double* plastic_strain;       ///< –     ε̄p at t_{n+1}
  const double* plastic_rate;         ///< 1/s   dε̄p/dt of the step
  const double* equivalent_stress;    ///< Pa
  const double* dissipation;          ///< J/m³  plastic work of the step per stress-free volume
  const double* stress_free;          ///< –     V_stress-free/V_reference
  const double* length;               ///< m     ℓ, thickness of the band that a broken point stands for
  const double* volume;               ///< V_p of the reference
  // in and out
  double* damage;            ///< –     D in [0, 1]
  double* softening;         ///< –     ω in [0, 1]
  double* initiation_strain; ///< –     ε̄p at which D reached 1; 0 before
  double* piola[general];    ///< Pa    in: as the return map left it
  double* pressure;          ///< Pa    the same
  double* stored_energy;     ///< J/m³  the same
};

/// Constants of a material and a step. What would cost a division is kept inverted.
struct DamageParameters {
  double D1, D2, D3, D4, D5;   ///< –
  double T0, by_melting_range; ///< K, 1/K
  double by_rate0;             ///< s
  double cut_off;              ///< –     σ_m/σ_eq at and below which nothing accumulates
  double by_fracture_energy;   ///< m²/J
  double by_two_kappa;         ///< 1/Pa
  double dt;                   ///< s
};

#define CNEM_DAMAGE(isa)                                                                                     \
  namespace isa {                                                                                            \
  template<int dim>                                                                                          \
  double damage(const DamageParameters& parameters, const DamagePoints<dim>& points, std::ptrdiff_t begin,   \
                std::ptrdiff_t end);                                                                         \
  }
CNEM_DAMAGE(baseline)
CNEM_DAMAGE(avx2)
CNEM_DAMAGE(avx512)
#undef CNEM_DAMAGE

} // namespace cnem::plasticity
