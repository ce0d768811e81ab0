// Small static problems solved with the operators: the patch test of elasticity and the order of convergence
// of Poisson's equation, with and without the edge defect.
#include "cnem/scni.hpp"
#include "sparse.hpp"
#include "tests/clouds.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

TEST(StaticPatch, patch_elastic_interior_follows_the_linear_boundary) {
  const double lambda = 2.0, mu = 1.0, alpha = 0.05;
  Mat2 displacement;
  displacement << 0.1, 0.3, -0.2, 0.05;
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    const auto approximation = scni::Cnem().rebuild(domain.cloud);
    const auto [gx, gy] = gradient_matrices(approximation.mechanics);
    const Sparse d = defect_matrix(approximation, domain.cloud.position);
    const Vector volume = as_vector(approximation.mechanics.volume);
    const auto v = volume.asDiagonal();
    const auto block = [&](const Sparse& a, const Sparse& b) { return Sparse(a.transpose() * (v * b)); };
    const Sparse defect = alpha * mu * Sparse(d.transpose() * d);
    const std::array<Sparse, 4> k{Sparse((lambda + 2 * mu) * block(gx, gx) + mu * block(gy, gy) + defect),
                                  Sparse(lambda * block(gx, gy) + mu * block(gy, gx)),
                                  Sparse(lambda * block(gy, gx) + mu * block(gx, gy)),
                                  Sparse((lambda + 2 * mu) * block(gy, gy) + mu * block(gx, gx) + defect)};
    const int n = domain.cloud.nodes();
    std::vector<Eigen::Triplet<double>> entries;
    for (int b = 0; b < 4; ++b)
      for (int c = 0; c < n; ++c)
        for (Sparse::InnerIterator it(k[std::size_t(b)], c); it; ++it)
          entries.emplace_back(b / 2 * n + it.row(), b % 2 * n + it.col(), it.value());
    Sparse stiffness(2 * n, 2 * n);
    stiffness.setFromTriplets(entries.begin(), entries.end());

    Vector exact(2 * n);
    for (int i = 0; i < n; ++i) {
      const Vec2 u = displacement * domain.cloud.position[std::size_t(i)];
      exact[i] = u.x();
      exact[n + i] = u.y();
    }
    std::set<int> fixed;
    for (const auto i : boundary_nodes(domain.cloud)) fixed.insert({i, n + i});
    const Vector u = solve(stiffness, Vector::Zero(2 * n), exact, fixed);
    EXPECT_LT((u - exact).lpNorm<Eigen::Infinity>(), 1e-11);
  }
}

/// L2 error of −Δu = 2π² sin(πx) sin(πy) on the unit square with u = 0 around it.
double poisson_error(const Approximation<2>& approximation, const DiscreteOperators<2>& op, double alpha,
                     const Cloud<2>& cloud) {
  const auto exact = [](const Vec2& x) {
    return std::sin(std::numbers::pi * x.x()) * std::sin(std::numbers::pi * x.y());
  };
  const auto [gx, gy] = gradient_matrices(op);
  const Vector volume = as_vector(op.volume);
  const auto v = volume.asDiagonal();
  Sparse stiffness = Sparse(gx.transpose() * (v * gx)) + Sparse(gy.transpose() * (v * gy));
  if (alpha > 0) {
    const Sparse d = defect_matrix(approximation, cloud.position);
    stiffness += alpha * Sparse(d.transpose() * d);
  }
  const Field share = op.node_volume();
  Vector u(cloud.nodes()), load(cloud.nodes());
  for (int i = 0; i < cloud.nodes(); ++i) {
    u[i] = exact(cloud.position[std::size_t(i)]);
    load[i] = 2 * std::numbers::pi * std::numbers::pi * u[i] * share[std::size_t(i)];
  }
  const auto boundary = boundary_nodes(cloud);
  const Vector given = Vector::Zero(cloud.nodes());
  const Vector error = solve(stiffness, load, given, boundary) - u;
  return std::sqrt(error.cwiseAbs2().dot(as_vector(share)));
}

TEST(Poisson, converges_with_second_order_and_the_defect_lowers_the_error) {
  const std::vector<int> divisions{12, 24, 48};
  for (const auto functions : {scni::Functions::sibson, scni::Functions::laplace}) {
    double with_one_point = 0.0;
    for (int points = 1; points <= 3; ++points) {
      SCOPED_TRACE((functions == scni::Functions::sibson ? "sibson " : "laplace ") + std::to_string(points));
      std::vector<double> plain, stabilised, triangles;
      for (const int n : divisions) {
        const Cloud<2> cloud = jittered_square(1.0 / n, 0.25, 7);
        const auto a = scni::Cnem({functions, points}).rebuild(cloud);
        plain.push_back(poisson_error(a, a.mechanics, 0.0, cloud));
        stabilised.push_back(poisson_error(a, a.mechanics, 0.05, cloud));
        triangles.push_back(poisson_error(a, a.conduction, 0.0, cloud));
        EXPECT_LT(stabilised.back(), plain.back());
      }
      EXPECT_GT(std::log2(stabilised.front() / stabilised.back()) / 2, 1.9);
      EXPECT_GT(std::log2(triangles.front() / triangles.back()) / 2, 1.9);
      EXPECT_LT(stabilised.back(), 2e-3);
      // In this scalar problem; in elasticity two points are better (cases/verification/convergence).
      if (points == 1) with_one_point = stabilised.back();
      EXPECT_LE(with_one_point, stabilised.back());
    }
  }
}

} // namespace
} // namespace cnem::testing
