#pragma once
// The edge defect of plies that fail (mechanics/edge_kernel.cpp).
#include "mechanics/step_kernels.hpp"

namespace cnem {

#define CNEM_FAILING_LINKS(isa)                                                                              \
  namespace isa {                                                                                            \
  EdgeEnergy failing_edge_defect(const LinkRows& links, double alpha, const double* volume,                  \
                                 const double* position, const double* record, double* stress,               \
                                 double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end);            \
  }
/// edge_defect<2> with the smaller of the moduli at a link's ends in the place of their mean: where one end
/// has failed, half of the other's modulus would hold the crack together.
CNEM_FAILING_LINKS(baseline)
CNEM_FAILING_LINKS(avx2)
CNEM_FAILING_LINKS(avx512)
#undef CNEM_FAILING_LINKS

} // namespace cnem
