#include "core/sparse_cholesky.hpp"

#include "core/error.hpp"

#ifdef CNEM_CHOLMOD
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

#include <cmath>
#include <fmt/format.h>

namespace cnem {

struct SparseCholesky::Factor {
#ifdef CNEM_CHOLMOD
  Eigen::CholmodSupernodalLLT<SparseMatrix> cholesky;
#else
  Eigen::SimplicialLLT<SparseMatrix> cholesky;
#endif
};

SparseCholesky::SparseCholesky(const SparseMatrix& matrix) : factor_(std::make_unique<Factor>()) {
  scale_ = matrix.diagonal();
  for (Eigen::Index i = 0; i < scale_.size(); ++i) {
    if (!(scale_[i] > 0.0))
      throw InputError(
          fmt::format("the stiffness of unknown {} is {:g}, expected a positive one", i, scale_[i]));
    scale_[i] = 1.0 / std::sqrt(scale_[i]);
  }
  scaled_ = scale_.asDiagonal() * matrix * scale_.asDiagonal();
  factor_->cholesky.compute(scaled_);
  if (factor_->cholesky.info() != Eigen::Success)
    throw InputError("the stiffness matrix is not positive definite to working precision");
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;

Eigen::VectorXd SparseCholesky::solve_scaled(const Eigen::VectorXd& right) const {
  return factor_->cholesky.solve(right);
}

Eigen::VectorXd SparseCholesky::solve(const Eigen::VectorXd& right) const {
  const Eigen::VectorXd b = scale_.cwiseProduct(right);
  Eigen::VectorXd x = solve_scaled(b);
  x += solve_scaled(b - scaled_ * x);
  return scale_.cwiseProduct(x);
}

double SparseCholesky::condition() const {
  constexpr int iterations = 30;
  const Eigen::Index n = scaled_.rows();
  const auto largest = [&](auto&& apply) {
    Eigen::VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i) x[i] = 1.0 + 0.5 * std::sin(static_cast<double>(7 * i + 1));
    double value = 0.0;
    for (int k = 0; k < iterations; ++k) {
      x.normalize();
      x = apply(x);
      value = x.norm();
    }
    return value;
  };
  return largest([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return scaled_ * x; }) *
         largest([&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return solve_scaled(x); });
}

} // namespace cnem
