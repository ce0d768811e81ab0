#pragma once
// Sparse Cholesky factorisation of symmetric positive definite matrices: CHOLMOD's supernodal one where it
// was found when the program was configured, Eigen's own otherwise.
#include <Eigen/SparseCore>

#include <memory>

namespace cnem {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Factorises K after scaling it to a unit diagonal.
class SparseCholesky {
public:
  /// `matrix`: symmetric, both triangles stored. Throws InputError when it is not positive definite.
  explicit SparseCholesky(const SparseMatrix& matrix);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;

  /// K⁻¹ b, refined with the residual once.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  /// λ_max/λ_min of the scaled matrix by power and inverse iteration, to about 10%.
  double condition() const;

private:
  struct Factor;
  Eigen::VectorXd solve_scaled(const Eigen::VectorXd& right) const;
  SparseMatrix scaled_;
  Eigen::VectorXd scale_; ///< diag(K)^(−1/2)
  std::unique_ptr<Factor> factor_;
};

} // namespace cnem
