// The trial stress in space and what flow makes of b_e, by polynomials and beyond their range by rotations,
// against functions of principal values.
#include "plasticity/trial_stress.hpp"
#include "tests/clouds.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace cnem::plasticity {
namespace {

using Mat3 = Eigen::Matrix3d;
using Tensor = double[6];

constexpr double two_mu = 160e9;
constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};

Mat3 matrix(const Tensor& a) {
  Mat3 m;
  for (int c = 0; c < 6; ++c) m(row[c], column[c]) = m(column[c], row[c]) = a[c];
  return m;
}

/// b = Σ exp(2 ε_k) n_k ⊗ n_k in random directions.
Mat3 state(testing::Random& random, const Eigen::Vector3d& strain) {
  const auto any = [&] {
    return Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  const Mat3 axes = Eigen::AngleAxisd(random.uniform(0, 3), any().normalized()).toRotationMatrix();
  return axes * (2.0 * strain).array().exp().matrix().asDiagonal() * axes.transpose();
}

void compare(const Mat3& b, double shrink) {
  Tensor components, change, tau;
  for (int c = 0; c < 6; ++c) components[c] = b(row[c], column[c]);
  const generic::TrialStress<3, double> trial(components, two_mu);
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(b);
  const Eigen::Vector3d l = solver.eigenvalues(), strain = 0.5 * l.array().log();
  const Eigen::Vector3d s = two_mu * (strain.array() - strain.mean());
  const auto of = [&](const Eigen::Vector3d& principal) -> Mat3 {
    return solver.eigenvectors() * principal.asDiagonal() * solver.eigenvectors().transpose();
  };
  // what rounding of b itself makes of strains
  constexpr double rounding = 3e-15;
  EXPECT_TRUE(trial.positive());
  EXPECT_NEAR(trial.total, strain.sum(), rounding);
  EXPECT_NEAR(trial.q, std::sqrt(1.5) * s.norm(), rounding * two_mu);
  EXPECT_NEAR(trial.determinant(), l.prod(), 2.0 * rounding * l.prod());
  trial.stress(0.5, 1e9, tau);
  EXPECT_LT((matrix(tau) - of(0.5 * s) - 1e9 * Mat3::Identity()).norm(), rounding * two_mu);
  const double factor = -2.0 * shrink / two_mu;
  trial.flow(factor, change);
  const Eigen::Vector3d exact =
      l.array() * (factor * s.array()).unaryExpr([](double x) { return std::expm1(x); });
  EXPECT_LT((matrix(change) - of(exact)).norm(), 2.0 * rounding * b.norm());
}

TEST(TrialStress, of_any_size_is_that_of_principal_values) {
  testing::Random random(1);
  for (int n = 0; n < 400; ++n) {
    const double size = std::pow(10.0, random.uniform(-8.0, -0.5)), volume = random.uniform(-0.05, 0.05);
    const Eigen::Vector3d strain(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    compare(state(random, size * strain + Eigen::Vector3d::Constant(volume)), random.uniform(0.0, 1.0));
  }
}

TEST(TrialStress, does_not_mind_equal_principal_values) {
  testing::Random random(2);
  for (const double size : {0.0, 1e-12, 1e-4, 5e-3, 0.0199, 0.0201, 0.1})
    for (const Eigen::Vector3d& way :
         {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, -2)})
      compare(state(random, size * way), 0.7);
}

TEST(TrialStress, tensors_that_are_not_positive_are_told) {
  EXPECT_FALSE((generic::TrialStress<3, double>({1.0, 1.0, -1e-3, 0, 0, 0}, two_mu).positive()));
  EXPECT_FALSE((generic::TrialStress<3, double>({-1.0, -1.0, -1.0, 0, 0, 0}, two_mu).positive()));
  EXPECT_FALSE((generic::TrialStress<3, double>({1.0, 1.0, std::nan(""), 0, 0, 0}, two_mu).positive()));
}

} // namespace
} // namespace cnem::plasticity
