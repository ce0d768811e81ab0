#pragma once
// What the damage pass reads and writes, and its entry points, one per instruction set. No function
// definitions and no standard containers here (see plasticity/stress_points.hpp).
#include "plasticity/stress_points.hpp"

#include <cstddef>

namespace cnem::plasticity {

/// Pointers to the fields of stress points, indexed [point].
template<int dim> struct DamagePoints {
  StressPoints<dim> stress; ///< as the return map left it; P, pressure and stored energy are changed
  const double* length;     ///< m     ℓ, thickness of the band that a broken point stands for
  const double* volume;     ///< V_p of the reference
  const double* opening; ///< –     ln of the volume ratio up to which a gap takes dilatation without tension
  // in and out
  double* damage;            ///< –     D in [0, 1]
  double* softening;         ///< –     ω in [0, 1]
  double* initiation_strain; ///< –     ε̄p at which softening began; 0 before
};

/// Constants of a material and a step. What would cost a division is kept inverted.
struct DamageParameters {
  int law;                    ///< its place in plasticity/damage_laws/list.hpp
  const void* constants;      ///< its struct
  double by_fracture_energy;  ///< m²/J
  double kappa, by_two_kappa; ///< Pa, 1/Pa
  double dt;                  ///< s
  bool relieves;              ///< tension has to be taken: no flow takes it, as in plane stress
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
