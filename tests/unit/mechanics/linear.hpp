#pragma once
// The linearised force of a method, from the very functions the explicit step uses: K u = −f for small u.
#include "core/error.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/terms/edge_defect.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <Eigen/Eigenvalues>

namespace cnem::testing {

struct Linear {
  Eigen::MatrixXd stiffness; ///< N/m² (N/m of revolution), dofs node-major
  Eigen::VectorXd mass;      ///< kg/m (kg), per dof
};

/// Of points with these moduli λ, Pa, and one μ.
inline Linear linearise(Approximation<2>& approximation, const Cloud<2>& cloud, const Field& lambdas,
                        double mu, double density, double alpha) {
  const DiscreteOperators<2>& op = approximation.mechanics;
  const auto n = static_cast<std::size_t>(op.nodes), points = static_cast<std::size_t>(op.points);
  EdgeDefect<2> edges(alpha);
  edges.reset(Field(points, mu));
  Fields<2> X, x, force;
  resize_all(X, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) X[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
  x = X;
  Fields<5> F, P;
  resize_all(F, points);
  resize_all(P, points);
  Linear linear{Eigen::MatrixXd(2 * n, 2 * n), Eigen::VectorXd(2 * n)};
  const Field volume = op.node_volume();
  const double unit = 1e-3;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t d = 0; d < 2; ++d) {
      x[d][j] += unit;
      const Field side = side_by_side<2>(x);
      deformation_gradient<2>(op, side, F, 0, points);
      for (std::size_t p = 0; p < points; ++p) {
        const double lambda = lambdas[p], exx = F[0][p] - 1.0, eyy = F[3][p] - 1.0,
                     exy = 0.5 * (F[1][p] + F[2][p]);
        const double ezz = op.of_revolution() ? F[4][p] - 1.0 : 0.0;
        P[0][p] = lambda * (exx + eyy + ezz) + 2.0 * mu * exx;
        P[3][p] = lambda * (exx + eyy + ezz) + 2.0 * mu * eyy;
        P[4][p] = lambda * (exx + eyy + ezz) + 2.0 * mu * ezz;
        P[1][p] = P[2][p] = 2.0 * mu * exy;
      }
      resize_all(force, n);
      ColumnStress<2> stress;
      copy_stress_columns<2>(P, stress);
      if (edges.active(approximation.links)) {
        edges.store_records(F, side_by_side<2>(X), 0, n);
        edges.apply(approximation.links, op.volume, side, stress, force, 0, n);
      }
      subtract_internal_force<2>(op, stress, force, 0, n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 2; ++k)
          linear.stiffness(static_cast<Eigen::Index>(2 * i + k), static_cast<Eigen::Index>(2 * j + d)) =
              -force[k][i] / unit;
      linear.mass[static_cast<Eigen::Index>(2 * j + d)] = density * volume[j];
      x[d][j] = X[d][j];
    }
  return linear;
}

inline Linear linearise(Approximation<2>& approximation, const Cloud<2>& cloud,
                        const plasticity::Material& material, double alpha) {
  const auto points = static_cast<std::size_t>(approximation.mechanics.points);
  return linearise(approximation, cloud, Field(points, material.elasticity.lambda()),
                   material.elasticity.mu(), material.density, alpha);
}

/// Eigenvalues ω² of M⁻¹K, increasing.
inline Eigen::VectorXd squared_frequencies(const Linear& linear) {
  const Eigen::VectorXd s = linear.mass.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd symmetric = 0.5 * (linear.stiffness + linear.stiffness.transpose());
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(s.asDiagonal() * symmetric * s.asDiagonal(),
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

} // namespace cnem::testing
