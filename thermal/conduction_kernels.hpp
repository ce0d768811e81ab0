#pragma once
// The two passes of conduction, one entry per instruction set; raw pointers only (cmake/cnem.cmake,
// cnem_kernel). Vectors side by side (core/operators/side_by_side.hpp).
#include "core/operators/sparse_rows.hpp"

#include <cstddef>

namespace cnem {

// Simplices that carry heat may go flat and inside out between two references, as a film is drawn out. With
// their measure as it stands they would conduct without bound, and then from cold to hot. They conduct as if
// it were positive and not below a share of what their sides allow: less than a hundred times as well as on
// the reference. Conduction takes at most a hundredth of the step that was stable there
// (mechanics/terms/heat.cpp).
constexpr double least_of_square = 0.01; ///< of det F over ‖F‖², which is 0.5 on the reference
constexpr double least_of_cube = 0.004;  ///< in space over ‖F‖³, which is 0.19 on the reference
constexpr double least_of_sides =
    0.004; ///< of 2A over the sum of the squares of the sides, 0.29 if they are equal
constexpr double least_of_edges =
    0.0005; ///< of 6V over the 3/2nd power of the sum of the squares of the edges, 0.048 if they are equal
constexpr double conducting(double area, double least) {
  const double size = area < 0.0 ? -area : area;
  return size < least ? least : size;
}

#define CNEM_CONDUCTION_KERNELS(isa)                                                                         \
  namespace isa {                                                                                            \
  /* flux [point − begin][k] = k J F⁻¹F⁻ᵀ ∇_X T; hoop [entry] of revolution, else null */         \
  /* the first `unread` entries have no weights: those of the next one come first */                         \
  template<int dim>                                                                                          \
  void conduction_flux(const OperatorRows<dim>& rows, std::ptrdiff_t unread, const double* hoop,             \
                       const double* position, const double* temperature, const double* conductivity,        \
                       double* flux, std::ptrdiff_t begin, std::ptrdiff_t end);                              \
  /* linear triangles: heat [triangle][3] into their nodes, from present positions alone */                  \
  void conduction_triangles(const NodeIndex* node, const double* position, const double* temperature,        \
                            const double* conductivity, double* heat, std::ptrdiff_t begin,                  \
                            std::ptrdiff_t end);                                                             \
  /* the same of tetrahedra, heat [tetrahedron][4] */                                                        \
  void conduction_tetrahedra(const NodeIndex* node, const double* position, const double* temperature,       \
                             const double* conductivity, double* heat, std::ptrdiff_t begin,                 \
                             std::ptrdiff_t end);                                                            \
  /* flow += heat of the node's corners */                                                                   \
  void conduction_corners(const std::int32_t* first, const std::int32_t* corner, const double* heat,         \
                          double* flow, std::ptrdiff_t begin, std::ptrdiff_t end);                           \
  /* flow −= Σ V b · flux */                                                                             \
  template<int dim>                                                                                          \
  void conduction_flow(const OperatorColumns<dim>& columns, const double* flux, double* flow,                \
                       std::ptrdiff_t begin, std::ptrdiff_t end);                                            \
  }
CNEM_CONDUCTION_KERNELS(baseline)
CNEM_CONDUCTION_KERNELS(avx2)
CNEM_CONDUCTION_KERNELS(avx512)
#undef CNEM_CONDUCTION_KERNELS

} // namespace cnem
