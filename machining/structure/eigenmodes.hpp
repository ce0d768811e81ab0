#pragma once
// Free vibrations of a structure, K φ = ω² M φ, and the structure in their coordinates.
#include "core/sparse_cholesky.hpp"
#include "core/vec.hpp"
#include "machining/mode.hpp"

#include <numbers>
#include <vector>

namespace cnem::machining {

struct Eigenmodes {
  Eigen::VectorXd omega; ///< rad/s, ascending
  Eigen::MatrixXd shape; ///< [unknowns × modes], φᵀ M φ = 1

  Eigen::Index count() const { return omega.size(); }
  double frequency(Eigen::Index mode) const { return omega[mode] / (2.0 * std::numbers::pi); } ///< Hz
};

/// The lowest `count` of them, by block Lanczos on K⁻¹ M with the factor of K (Golub and Underwood 1977),
/// until frequencies change by less than 1e-10 of themselves and residuals are below 1e-7, or, where rounding
/// keeps them from it, below 1e-4 after eight more blocks. Modes of the same frequency
/// are all found, up to four. The same bits for the same matrices. Throws InputError where K is not positive
/// definite, where modes do not come together, and when there are fewer unknowns than modes.
Eigenmodes lowest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass, Eigen::Index count);

/// Damping of each mode: its own, or Rayleigh's C = α M + β K.
struct Rayleigh {
  double mass = 0.0, stiffness = 0.0; ///< α 1/s, β s
  double of_mode(double omega) const { return 0.5 * (mass / omega + stiffness * omega); }
};

/// What a mode is to a cutter at a place, where it moves by `shape` of a unit of its coordinate, m/(m √kg):
/// stiffness along the direction in which it moves there.
Mode mode_at(double omega, double damping, const Vec3& shape, Mode::Of of);

} // namespace cnem::machining
