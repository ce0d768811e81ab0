#pragma once
// What points of plies have beside other stress points, as plain pointers (plasticity/stress_points.hpp).

namespace cnem::plasticity {

/// The modes in which a ply fails, in the order of fields.
enum PlyMode { fibre_tension, fibre_compression, matrix_tension, matrix_compression, ply_shear };
inline constexpr int ply_modes = 5;

/// Pointers to fields, indexed [point], lists over modes [mode][point].
struct PlyPoints {
  double* fibre_angle; ///< rad, of the fibres from +x at present; null: no point is of a ply
  double* flow[3];     ///< –   E^p: ε11, ε22, γ12 in the axes of the ply; null: no ply flows
  // null where no ply fails
  double* damage[ply_modes]; ///< –      d, at most 0.99
  double* left[ply_modes];   ///< –      of the stiffness, 1 − d and less where it has opened further
  double* index[ply_modes];  ///< –      f, of the present strain
  double* onset_strain[ply_modes]; ///< m      δ0, of the length ℓ, where f reached 1
  double* onset_stress[ply_modes]; ///< Pa     σ0 there
  double* begun[ply_modes];        ///< –      1 from then on
  double* strain[3];               ///< –      ε11, ε22, γ12 at t_n
  double* release;                 ///< J/m³   let go by damage in this step per unit stress-free volume
  const double* length;            ///< m      ℓ
};

} // namespace cnem::plasticity
