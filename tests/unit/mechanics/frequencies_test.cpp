// Free-plate frequencies: what stabilisation is for.
#include "tests/unit/mechanics/linear.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::testing {
namespace {

/// Frequencies of the free rectangle [0, a] × [0, b] in plane strain by one p-version finite element of
/// degree `degree` (Legendre functions, Gauss quadrature that is exact): mode 10 moves by less than 1e-3 from
/// degree 10 to 12.
Eigen::VectorXd p_version_squared_frequencies(double a, double b, const plasticity::Material& material,
                                              int degree) {
  const int q = degree + 1;
  // Gauss-Legendre points by Newton on P_q.
  Eigen::VectorXd t(q), w(q);
  for (int i = 0; i < q; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (q + 0.5)), derivative = 1.0;
    for (int it = 0; it < 50; ++it) {
      double p0 = 1.0, p1 = x;
      for (int k = 2; k <= q; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      derivative = q * (x * p1 - p0) / (x * x - 1.0);
      x -= p1 / derivative;
    }
    t[i] = x;
    w[i] = 2.0 / ((1.0 - x * x) * derivative * derivative);
  }
  Eigen::MatrixXd value(q, q), slope(q, q); // [point][function]
  for (int i = 0; i < q; ++i) {
    value(i, 0) = 1.0;
    slope(i, 0) = 0.0;
    value(i, 1) = t[i];
    slope(i, 1) = 1.0;
    for (int k = 2; k < q; ++k) {
      value(i, k) = ((2 * k - 1) * t[i] * value(i, k - 1) - (k - 1) * value(i, k - 2)) / k;
      slope(i, k) = (2 * k - 1) * value(i, k - 1) + slope(i, k - 2);
    }
  }
  const double lambda = material.elasticity.lambda(), mu = material.elasticity.mu();
  Eigen::MatrixXd C(3, 3);
  C << lambda + 2 * mu, lambda, 0, lambda, lambda + 2 * mu, 0, 0, 0, mu;
  const int n = q * q;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n, 2 * n), M = K;
  for (int i = 0; i < q; ++i)
    for (int j = 0; j < q; ++j) {
      Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, 2 * n), N = Eigen::MatrixXd::Zero(2, 2 * n);
      for (int k = 0; k < q; ++k)
        for (int l = 0; l < q; ++l) {
          const int f = k * q + l;
          const double dx = slope(i, k) * value(j, l) * 2 / a, dy = value(i, k) * slope(j, l) * 2 / b;
          B(0, 2 * f) = dx;
          B(1, 2 * f + 1) = dy;
          B(2, 2 * f) = dy;
          B(2, 2 * f + 1) = dx;
          N(0, 2 * f) = N(1, 2 * f + 1) = value(i, k) * value(j, l);
        }
      const double weight = w[i] * w[j] * a * b / 4;
      K += weight * B.transpose() * C * B;
      M += weight * material.density * N.transpose() * N;
    }
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

TEST(Frequencies, free_plate_modes_1_to_10_within_5_percent) {
  const double a = 2e-2, b = 1e-2;
  const plasticity::Material material = steel();
  const Eigen::VectorXd reference = p_version_squared_frequencies(a, b, material, 12);
  const Eigen::VectorXd coarser = p_version_squared_frequencies(a, b, material, 10);
  const Cloud<2> cloud = rectangle(a, b, 0.75e-3, Lattice::hexagonal, 0.15);
  Approximation<2> approximation = make(Method::cnem)->rebuild(cloud);
  const Eigen::VectorXd bare = squared_frequencies(linearise(approximation, cloud, material, 0.0));
  const Eigen::VectorXd stabilised = squared_frequencies(linearise(approximation, cloud, material, 0.05));
  for (int mode = 0; mode < 10; ++mode) {
    const double exact = std::sqrt(reference[3 + mode]);
    EXPECT_NEAR(std::sqrt(coarser[3 + mode]), exact, 1e-3 * exact) << "the reference has not converged";
    EXPECT_NEAR(std::sqrt(stabilised[3 + mode]), exact, 0.05 * exact) << "mode " << mode + 1;
  }
  EXPECT_LT(std::sqrt(bare[12]), 0.7 * std::sqrt(reference[12]))
      << "without the penalty weak modes come first";
  for (int rigid = 0; rigid < 3; ++rigid) EXPECT_LT(std::abs(stabilised[rigid]), 1e-6 * stabilised[3]);
}

TEST(StableStep, bound_is_below_the_exact_step_and_not_far) {
  for (const double poisson : {0.0, 0.33, 0.49})
    for (const double jitter : {0.0, 0.25})
      for (const double alpha : {0.0, 0.05, 0.5})
        for (const Method method : {Method::cnem, Method::triangles, Method::sph}) {
          plasticity::Material material = steel();
          material.elasticity.poisson = poisson;
          const Cloud<2> cloud = rectangle(8e-3, 6e-3, 1e-3, Lattice::hexagonal, jitter, 7);
          Approximation<2> approximation = make(method)->rebuild(cloud);
          const Linear linear = linearise(approximation, cloud, material, alpha);
          const Eigen::VectorXd omega2 = squared_frequencies(linear);
          const double exact = 2.0 / std::sqrt(omega2[omega2.size() - 1]);
          Problem<2> model = model_of(cloud, method, material);
          model.stabilisation = alpha;
          model.safety = 1.0;
          ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
          const double bound = solver.stable_step().dt;
          EXPECT_LT(bound, exact) << "poisson " << poisson << " jitter " << jitter << " alpha " << alpha;
          EXPECT_GT(bound, 0.4 * exact)
              << "poisson " << poisson << " jitter " << jitter << " alpha " << alpha;
        }
}

} // namespace
} // namespace cnem::testing
