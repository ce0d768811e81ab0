#pragma once
// Decay rates of a body that conducts, and whether they stay what heat allows where triangles turn inside
// out.
#include "core/operators/side_by_side.hpp"
#include "core/vec.hpp"
#include "thermal/conduction.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace cnem::testing {

/// C^−½ K C^−½ of a body, 1/s.
template<class Conductor> Eigen::MatrixXd decay_matrix(Conductor& body) {
  const auto n = static_cast<Eigen::Index>(body.capacity.size());
  body.temperature.assign(body.capacity.size(), 0.0);
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::fill(body.temperature.begin(), body.temperature.end(), 0.0);
    body.temperature[static_cast<std::size_t>(j)] = 1.0;
    std::fill(body.flow.begin(), body.flow.end(), 0.0);
    body.conduction.add_flow(side_by_side<2>(body.position), body.temperature, body.flow);
    for (Eigen::Index i = 0; i < n; ++i)
      K(i, j) =
          -body.flow[static_cast<std::size_t>(i)] /
          std::sqrt(body.capacity[static_cast<std::size_t>(i)] * body.capacity[static_cast<std::size_t>(j)]);
  }
  return K;
}

inline Eigen::VectorXd decay_rates(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

/// The node nearest to `place` is led across the sides opposite to it, two `spacings` along x: triangles are
/// flat on the way, and inside out beyond.
template<class Conductor> void expect_bounded_conduction(Conductor& body, const Vec2& place, double spacing) {
  std::size_t node = 0;
  const auto off = [&](std::size_t i) { return (body.cloud.position[i] - place).norm(); };
  for (std::size_t i = 0; i < body.capacity.size(); ++i)
    if (off(i) < off(node)) node = i;
  const double on_the_reference =
      body.conduction.fastest_decay(side_by_side<2>(body.position), body.capacity);
  const double start = body.position[0][node];
  for (int n = 0; n <= 40; ++n) {
    body.position[0][node] = start + spacing * n / 20.0;
    const Eigen::MatrixXd K = decay_matrix(body);
    const Eigen::VectorXd rates = decay_rates(K);
    EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm());
    EXPECT_GT(rates.minCoeff(), -1e-9 * rates.maxCoeff()) << n << ": heat flows from cold to hot";
    EXPECT_LT(rates.maxCoeff(), 100.0 * on_the_reference) << n;
    const double bound = body.conduction.fastest_decay(side_by_side<2>(body.position), body.capacity);
    EXPECT_GT(bound, rates.maxCoeff()) << n;
  }
}

} // namespace cnem::testing
