#pragma once
// The constants of one material as the kernels read them, and their entry points, one per instruction set.
// No function definitions and no standard containers here (see plasticity/stress_points.hpp).
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity {

/// Highest power in the binomial series of (1 + y)ⁿ.
inline constexpr int series_order = 10;

struct Material;

/// Constants of a material and a step. What would cost a division is kept inverted.
struct ReturnMapParameters {
  double kappa, two_mu, three_mu;       ///< Pa
  double by_mu, by_three_mu, by_six_mu; ///< 1/Pa
  double three_expansion, reference;    ///< 1/K, K
  double dt, by_dt;                     ///< s, 1/s
  bool plastic;                         ///< has a flow stress and time to flow
  double A, B, n, C, m, T0;             ///< as in JohnsonCook
  double saturation;                    ///< Pa   Q
  double saturation_exponent;           ///< –    δ
  double by_melting_range;              ///< 1/K  1/(T_m − T0); 0: no thermal softening
  double by_reference_increment, by_C;  ///< –    1/(ε̄̇p0 dt), 1/C
  double reference_increment;           ///< –    ε̄̇p0 dt
  double series[series_order + 1];      ///< –    binomial coefficients: (1 + y)ⁿ = Σ series_k y^k
  double series_range;                  ///< –    |y| up to which the series is exact to rounding
};

ReturnMapParameters return_map_parameters(const Material& material, double dt);

#define CNEM_RETURN_MAP(isa)                                                                                 \
  namespace isa {                                                                                            \
  template<int dim>                                                                                          \
  std::ptrdiff_t return_map(const ReturnMapParameters& parameters, const StressPoints<dim>& points,          \
                            std::ptrdiff_t begin, std::ptrdiff_t end);                                       \
  }
CNEM_RETURN_MAP(baseline)
CNEM_RETURN_MAP(avx2)
CNEM_RETURN_MAP(avx512)
#undef CNEM_RETURN_MAP

} // namespace cnem::plasticity
