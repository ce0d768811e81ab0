#pragma once
// Hill's yield function as the kernels read it, and their entry points, one per instruction set. No function
// definitions and no standard containers here (see plasticity/stress_points.hpp).
#include "plasticity/return_map_parameters.hpp"

namespace cnem::plasticity {

/// σ̄² = Σ_k value_k a_k² of a stress along the axes of the sheet: a_0 and a_1 are Σ_i axis_ki σ_ii, a_2, a_3
/// and a_4 are √2 times the shear stresses xy, yz, zx. Mean stress has no part in it.
struct HillForm {
  double axis[2][3]; ///< –  orthonormal, and their components sum to 0
  double value[5];   ///< –  positive; 3/2 is von Mises
};

#define CNEM_HILL(isa)                                                                                       \
  namespace isa {                                                                                            \
  template<int dim>                                                                                          \
  std::ptrdiff_t hill_return_map(const ReturnMapParameters& parameters, const HillForm& form,                \
                                 const StressPoints<dim>& points, std::ptrdiff_t begin, std::ptrdiff_t end); \
  }
CNEM_HILL(baseline)
CNEM_HILL(avx2)
CNEM_HILL(avx512)
#undef CNEM_HILL

} // namespace cnem::plasticity
