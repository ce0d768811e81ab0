#pragma once
// The constants of one material as the kernels read them, and their entry points, one per instruction set.
// No function definitions and no standard containers here (see plasticity/stress_points.hpp).
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity {

struct Material;

/// A hardening law by its place in plasticity/laws/list.hpp, with its struct of constants.
struct HardeningView {
  int law;
  const void* constants;
};

/// Constants of a material and a step. What would cost a division is kept inverted.
struct ReturnMapParameters {
  double kappa, two_mu, three_mu;       ///< Pa
  double by_mu, by_three_mu, by_six_mu; ///< 1/Pa
  double three_expansion, reference;    ///< 1/K, K
  double dt, by_dt;                     ///< s, 1/s
  bool plastic;                         ///< has a flow stress and time to flow
  HardeningView hardening;              ///< any where `plastic` is false
};

/// Valid as long as the material.
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
