#pragma once
// Box 2 of paper 004 to the letter, with F^p, polar decomposition, matrix logarithm and exponential map: the
// reference that the production kernel must reproduce.
#include "plasticity/material.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace cnem::plasticity::test {

struct Box2Reference {
  Eigen::Matrix3d plastic = Eigen::Matrix3d::Identity(); ///< F^p
  double plastic_strain = 0.0;
  Eigen::Matrix3d kirchhoff = Eigen::Matrix3d::Zero(); ///< τ
  double increment = 0.0;                              ///< Δγ

  void step(const Material& material, const Eigen::Matrix3d& f, double temperature, double dt) {
    using Mat3 = Eigen::Matrix3d;
    const double mu = material.elasticity.mu(), lambda = material.elasticity.lambda();
    // (ii) elastic trial deformation gradient
    const Mat3 trial = f * plastic.inverse();
    // (iii) polar decomposition
    const Eigen::JacobiSVD<Mat3> svd(trial, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    // (iv) trial logarithmic strain, ln U^e
    const Mat3 v = svd.matrixV();
    const Mat3 strain = v * svd.singularValues().array().log().matrix().asDiagonal() * v.transpose();
    // (v) trial stress
    const Mat3 stress = lambda * strain.trace() * Mat3::Identity() + 2.0 * mu * strain;
    const Mat3 deviator = stress - stress.trace() / 3.0 * Mat3::Identity();
    const double q = std::sqrt(1.5) * deviator.norm();
    // (vi) plastic consistency
    increment = 0.0;
    Mat3 corrected = stress;
    if (material.hardening && q > material.hardening->flow_stress(plastic_strain, 0.0, temperature)) {
      // (vii) plastic corrector
      increment = solve(*material.hardening, q, 3.0 * mu, temperature, dt);
      // (viii) stress
      const double xi = 3.0 * mu * increment / (q - 3.0 * mu * increment);
      corrected = deviator / (1.0 + xi) + stress.trace() / 3.0 * Mat3::Identity();
      // (ix) plastic part: exp(Δγ N) F^p
      const Mat3 flow = 1.5 * increment * deviator / q;
      const Eigen::SelfAdjointEigenSolver<Mat3> eigen(flow);
      plastic = eigen.eigenvectors() * eigen.eigenvalues().array().exp().matrix().asDiagonal() *
                eigen.eigenvectors().transpose() * plastic;
      plastic_strain += increment;
    }
    kirchhoff = rotation * corrected * rotation.transpose();
  }

private:
  /// Bisection, then Newton steps as long as they shrink the residual.
  double solve(const Hardening& law, double q, double slope, double temperature, double dt) const {
    const auto residual = [&](double x) {
      return q - slope * x - law.flow_stress(plastic_strain + x, x / dt, temperature);
    };
    double low = 0.0, high = q / slope;
    for (int k = 0; k < 200 && high - low > 1e-9 * high; ++k) {
      const double middle = low > 0.0 ? std::sqrt(low * high) : 1e-4 * high;
      (residual(middle) > 0.0 ? low : high) = middle;
    }
    double x = 0.5 * (low + high);
    for (int k = 0; k < 3; ++k) {
      const double total = plastic_strain + x;
      const double tangent = slope + law.hardening_modulus(total, x / dt, temperature) +
                             law.rate_modulus(total, x / dt, temperature) / dt;
      const double next = x + residual(x) / tangent;
      if (next > low && next < high) x = next;
    }
    return x;
  }
};

} // namespace cnem::plasticity::test
