#pragma once
// The constants of one material as the kernels read them, and their entry points, one per instruction set.
// No function definitions and no standard containers here (see plasticity/stress_points.hpp).
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity {

/// Highest power in the binomial series of (1 + y)ⁿ.
inline constexpr int series_order = 10;

struct Material;

struct ReturnMapParameters {
  double mu, kappa;                      ///< Pa
  double expansion, expansion_reference; ///< 1/K, K
  bool plastic;                          ///< has a flow stress
  double A, B, n, C, rate0, m, T0;       ///< as in JohnsonCook
  double inverse_melting_range;          ///< 1/K  1/(T_m − T0); 0: no thermal softening
  double series[series_order + 1];       ///< –    binomial coefficients: (1 + y)ⁿ = Σ series_k y^k
  double series_range;                   ///< –    |y| up to which the series is exact to rounding
};

ReturnMapParameters return_map_parameters(const Material& material);

#define CNEM_RETURN_MAP(isa)                                                                                 \
  namespace isa {                                                                                            \
  template<int dim>                                                                                          \
  std::ptrdiff_t return_map(const ReturnMapParameters& parameters, const StressPoints<dim>& points,          \
                            std::ptrdiff_t begin, std::ptrdiff_t end, double dt);                            \
  }
CNEM_RETURN_MAP(baseline)
CNEM_RETURN_MAP(avx2)
CNEM_RETURN_MAP(avx512)
#undef CNEM_RETURN_MAP

} // namespace cnem::plasticity
