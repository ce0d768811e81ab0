#include "machining/structure/eigenmodes.hpp"

#include "core/error.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

using Eigen::Index;

namespace {

/// A block of vectors, and M times it.
struct Block {
  Eigen::MatrixXd vectors, times_mass;
};

/// Makes the columns M-orthonormal to a basis and to each other; a column that is all in the basis is
/// dropped.
Block orthonormal(Eigen::MatrixXd block, const Eigen::MatrixXd& basis,
                  const Eigen::MatrixXd& basis_times_mass, const SparseMatrix& mass) {
  Block made;
  Index kept = 0;
  made.vectors.resize(block.rows(), block.cols());
  made.times_mass.resize(block.rows(), block.cols());
  for (Index c = 0; c < block.cols(); ++c) {
    Eigen::VectorXd x = block.col(c);
    const double before = std::sqrt(x.dot(mass * x));
    for (int again = 0; again < 3; ++again) {
      x -= basis * (basis_times_mass.transpose() * x);
      x -= made.vectors.leftCols(kept) * (made.times_mass.leftCols(kept).transpose() * x);
    }
    Eigen::VectorXd mx = mass * x;
    const double length = std::sqrt(x.dot(mx));
    constexpr double negligible = 1e-12;
    if (!(length > negligible * before)) continue;
    made.vectors.col(kept) = x / length;
    made.times_mass.col(kept) = mx / length;
    ++kept;
  }
  made.vectors.conservativeResize(Eigen::NoChange, kept);
  made.times_mass.conservativeResize(Eigen::NoChange, kept);
  return made;
}

void append(Eigen::MatrixXd& to, const Eigen::MatrixXd& columns) {
  to.conservativeResize(columns.rows(), to.cols() + columns.cols());
  to.rightCols(columns.cols()) = columns;
}

} // namespace

Eigenmodes lowest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass, Index count) {
  const Index n = stiffness.rows();
  if (n < count)
    throw InputError(fmt::format("found {} unknowns for {} modes, expected more of them", n, count));
  const SparseCholesky factor(stiffness);
  constexpr Index width = 4;
  Eigen::MatrixXd start(n, std::min(width, n));
  for (Index c = 0; c < start.cols(); ++c) // no symmetry of a part leaves a mode out of it
    for (Index i = 0; i < n; ++i)
      start(i, c) = std::sin(1.0 + 1.7 * static_cast<double>(i * (c + 1)) + 0.37 * static_cast<double>(c));
  Eigen::MatrixXd basis(n, 0), times_mass(n, 0), image(n, 0); // V, M V, K⁻¹ M V
  Block next = orthonormal(start, basis, times_mass, mass);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(count);
  int steady_for = 0; // blocks
  while (next.vectors.cols() > 0) {
    append(basis, next.vectors);
    append(times_mass, next.times_mass);
    Eigen::MatrixXd solved(n, next.vectors.cols());
    for (Index c = 0; c < solved.cols(); ++c) solved.col(c) = factor.solve(next.times_mass.col(c));
    append(image, solved);
    if (basis.cols() >= count) {
      // Lazy products: the others are divided among threads, and their sums depend on how many there are.
      const Eigen::MatrixXd projected = times_mass.transpose().lazyProduct(image);
      const Eigen::MatrixXd symmetric = 0.5 * (projected + projected.transpose());
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(symmetric);
      const Eigen::VectorXd flexibility = ritz.eigenvalues().reverse().head(count); // 1/ω²
      const Eigen::MatrixXd mix = ritz.eigenvectors().rowwise().reverse().leftCols(count);
      constexpr double close = 1e-10, residual_close = 1e-7, by_rounding = 1e-4;
      constexpr int settled = 8; // blocks
      constexpr Index most_a_mode = 30;
      const bool steady = ((flexibility - before).array().abs() < close * flexibility.array()).all();
      before = flexibility;
      steady_for = steady ? steady_for + 1 : 0;
      if (basis.cols() > most_a_mode * (count + width))
        throw InputError(
            fmt::format("{} modes do not come together among {} vectors: the stiffness is singular "
                        "but for rounding, expected cells that are less thin",
                        count, basis.cols()));
      if (steady) {
        Eigenmodes modes;
        modes.omega = flexibility.cwiseSqrt().cwiseInverse();
        modes.shape = basis.lazyProduct(mix);
        const Eigen::MatrixXd residual = image.lazyProduct(mix) - modes.shape * flexibility.asDiagonal();
        const double most = (residual.colwise().norm().array() /
                             (modes.shape * flexibility.asDiagonal()).colwise().norm().array())
                                .maxCoeff();
        // Of thin parts rounding of K⁻¹ keeps residuals from falling further: frequencies err by the square.
        if (most < (steady_for < settled ? residual_close : by_rounding)) return modes;
      }
    }
    next = orthonormal(solved, basis, times_mass, mass);
  }
  // The basis is the whole space.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all{Eigen::MatrixXd(stiffness),
                                                                      Eigen::MatrixXd(mass)};
  return {all.eigenvalues().head(count).cwiseSqrt(), all.eigenvectors().leftCols(count)};
}

Mode mode_at(double omega, double damping, const Vec3& shape, Mode::Of of) {
  const double motion = shape.norm();
  return {.of = of,
          .frequency = omega / (2.0 * std::numbers::pi),
          .damping = damping,
          .stiffness = omega * omega / (motion * motion),
          .direction = shape / motion};
}

} // namespace cnem::machining
