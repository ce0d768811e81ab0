#include "machining/largest_eigenvalue.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cnem::machining {

namespace {

/// Of the leading square block of Hessenberg coefficients; vector in the basis of Arnoldi.
Eigenpair ritz_pair(const Eigen::MatrixXd& hessenberg, Eigen::Index m, bool with_vector) {
  const Eigen::MatrixXd square = hessenberg.topLeftCorner(m, m);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(square, with_vector);
  Eigen::Index best = 0;
  for (Eigen::Index i = 1; i < m; ++i)
    if (std::abs(solver.eigenvalues()[i]) > std::abs(solver.eigenvalues()[best])) best = i;
  Eigenpair pair{solver.eigenvalues()[best], {}};
  if (with_vector) pair.vector = solver.eigenvectors().col(best);
  return pair;
}

} // namespace

Eigenpair largest_eigenvalue(const LinearMap& map, Eigen::Index size, double tolerance) {
  const Eigen::Index most = std::min<Eigen::Index>(size, 400);
  Eigen::Index room = std::min<Eigen::Index>(most, 48);
  Eigen::MatrixXd basis(size, room + 1), hessenberg = Eigen::MatrixXd::Zero(room + 1, room);
  Eigen::VectorXd next(size), now(size);
  for (Eigen::Index i = 0; i < size; ++i) now[i] = 1.0 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  basis.col(0) = now.normalized();
  double before = -1.0;
  Eigen::Index m = 0, look = 12;
  while (m < most) {
    if (m == room) {
      room = std::min(most, 2 * room);
      basis.conservativeResize(Eigen::NoChange, room + 1);
      hessenberg.conservativeResizeLike(Eigen::MatrixXd::Zero(room + 1, room));
    }
    now = basis.col(m);
    map(now, next);
    const double scale = next.norm();
    for (int pass = 0; pass < 2; ++pass) { // once is not enough where little is left
      const Eigen::VectorXd share = basis.leftCols(m + 1).transpose() * next;
      next -= basis.leftCols(m + 1) * share;
      hessenberg.col(m).head(m + 1) += share;
    }
    const double rest = next.norm();
    ++m;
    if (!(rest > 1e-14 * scale)) break; // the space that was reached maps into itself
    hessenberg(m, m - 1) = rest;
    basis.col(m) = next / rest;
    if (m < look) continue;
    look = m + std::max<Eigen::Index>(6, m / 3);
    const double magnitude = std::abs(ritz_pair(hessenberg, m, false).value);
    if (std::abs(magnitude - before) <= tolerance * magnitude) break;
    before = magnitude;
  }
  Eigenpair pair = ritz_pair(hessenberg, m, true);
  pair.vector = basis.leftCols(m) * pair.vector;
  pair.vector.normalize();
  return pair;
}

} // namespace cnem::machining
