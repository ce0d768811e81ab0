#pragma once
// The passes of an explicit step that gather over neighbours or sweep over points, one entry per instruction
// set. Raw pointers only: kernels see no standard containers (cmake/cnem.cmake, cnem_kernel).
//
// What is gathered lies side by side, one record per node or point, so that a neighbour costs one cache line,
// in space one register a vector: positions [node][k]; stresses by columns [point][k][i] = P_ik; edge
// records.
#include "core/operators/sparse_rows.hpp"

#include <cstddef>
#include <cstdint>

namespace cnem {

/// Neighbour links of the stabilisation, each in the lists of both its ends.
struct LinkRows {
  const std::int32_t* begin;
  const NodeIndex* neighbour;
  const double* weight;
};

/// Numbers of the columns of a stress.
template<int dim> inline constexpr int column_stress = dim* beside<dim>;

/// What the edge defect reads of a node, numbered: the columns of F times `share`, the penalty's modulus of
/// this step and of the step before, X.
template<int dim> struct EdgeRecord;
template<> struct EdgeRecord<2> {
  static constexpr int modulus = 4, modulus_before = 5, place = 6, size = 8;
  static constexpr double share = 1.0;
};
/// In space the moduli stand in the fourth numbers of the first two columns.
template<> struct EdgeRecord<3> {
  static constexpr int modulus = 3, modulus_before = 7, place = 12, size = 16;
  static constexpr double share = 0.5;
};

/// ½ Σ k |r|² of the block's half of its links, and what falling moduli let go, J/m^(3−dim).
struct EdgeEnergy {
  double stored, released;
};

/// What is renewed for the edge defect with each stress, [point]; no record: the method has no links.
struct EdgePoints {
  const double* shear_modulus; ///< μ, Pa
  const double* plastic_strain;
  double* modulus;        ///< secant modulus μ̃, Pa; in: of the step before
  double* modulus_before; ///< out: that one
  double* record;         ///< out: edge records but for X
};

/// What the bulk viscosity reads and writes, [point].
template<int dim> struct ViscousPoints {
  static constexpr int general = dim == 2 ? 5 : 9;
  const double* deformation[general];
  const double* piola[general];
  const double* density;           ///< kg/m³ at F = 1
  const double* wave_modulus;      ///< λ + 2μ, Pa
  const double* volume;            ///< V_p
  const double* length_share;      ///< s of l = s V^{1/dim}
  const double* radius;            ///< r̄_p of revolution, else null
  double* jacobian;                ///< in: of the step before
  double* pressure;                ///< q, in: of the step before
  double* columns;                 ///< out: P − q J F⁻ᵀ by columns
  double* out_of_plane;            ///< out, in the plane: its zz component
  const double* plastic_rate;      ///< 1/s
  const double* equivalent_stress; ///< Pa
  double* flow_stress;             ///< Pa, where and when the point last flowed
  EdgePoints edge;
};

/// What the bound on the highest frequency reads; hoop entries are null but of revolution.
template<int dim> struct SpectralView {
  /// Numbers of a point: in the plane F⁻ᵀ by columns, det F, 1/F_θθ; in space the columns of det F · F⁻ᵀ side
  /// by side, in the fourth number of the first 1/det F.
  static constexpr int stride = dim == 2 ? 6 : 12;
  OperatorRows<dim> rows;       ///< b_pJ
  OperatorColumns<dim> columns; ///< V_p b_pJ
  const double* hoop;           ///< of `rows`
  const double* weighted_hoop;  ///< of `columns`
  const double* modulus;        ///< [point] k
  const double* weight;         ///< [node] M
  const double* share;          ///< [point] x
  double* inverse;              ///< [point][stride]
  double* transfer;             ///< [node] s_J
  double* image;                ///< [point] (A x)_p
};

struct ViscousSums {
  double dissipated, damping;
};

#define CNEM_STEP_KERNELS(isa)                                                                               \
  namespace isa {                                                                                            \
  template<int dim>                                                                                          \
  void deformation_rows(const OperatorRows<dim>& rows, const double* position, double* const* deformation,   \
                        std::ptrdiff_t begin, std::ptrdiff_t end);                                           \
  template<int dim>                                                                                          \
  void force_columns(const OperatorColumns<dim>& columns, const double* stress, double* const* force,        \
                     std::ptrdiff_t begin, std::ptrdiff_t end);                                              \
  template<int dim>                                                                                          \
  EdgeEnergy edge_defect(const LinkRows& links, double alpha, const double* volume, const double* position,  \
                         const double* record, double* stress, double* const* force, std::ptrdiff_t begin,   \
                         std::ptrdiff_t end);                                                                \
  template<int dim>                                                                                          \
  void invert(const double* const* deformation, const SpectralView<dim>& view, std::ptrdiff_t begin,         \
              std::ptrdiff_t end);                                                                           \
  template<int dim>                                                                                          \
  void spectral_transfer(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end);           \
  template<int dim>                                                                                          \
  void spectral_rows(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end);               \
  template<int dim>                                                                                          \
  ViscousSums viscous_stress(const ViscousPoints<dim>& points, double quadratic, double linear, double dt,   \
                             std::ptrdiff_t begin, std::ptrdiff_t end);                                      \
  }
CNEM_STEP_KERNELS(baseline)
CNEM_STEP_KERNELS(avx2)
CNEM_STEP_KERNELS(avx512)
#undef CNEM_STEP_KERNELS

} // namespace cnem
