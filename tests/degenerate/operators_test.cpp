// Operators on the adversarial clouds: they must build, reproduce linear fields and keep constant stress off
// the interior. Errors are measured against what the entries of a row add up to, which grows where nodes
// crowd.
#include "cnem/scni.hpp"
#include "methods/fe_simplices.hpp"
#include "random_clouds.hpp"

#include <gtest/gtest.h>

namespace cnem::voronoi::test {
namespace {

constexpr double tolerance = 1e-12;

void expect_linear_fields_reproduced(const Cloud<2>& cloud, const DiscreteOperators<2>& op) {
  for (std::size_t p = 0; p < static_cast<std::size_t>(op.points); ++p) {
    const auto begin = static_cast<std::size_t>(op.row_begin[p]),
               end = static_cast<std::size_t>(op.row_begin[p + 1]);
    const Vec2 origin = cloud.position[op.first_node(p)];
    Vec2 sum = Vec2::Zero();
    Mat2 identity = Mat2::Zero();
    double total = 0.0, scale = 1.0, last_bit = 0.0;
    for (std::size_t e = begin; e < end; ++e) {
      const Vec2 b(op.gradient[0][e], op.gradient[1][e]);
      const Vec2 r = cloud.position[static_cast<std::size_t>(op.node[e])] - origin;
      sum += b;
      identity += r * b.transpose();
      total += b.norm();
      scale += r.norm() * b.norm();
      last_bit = std::max(last_bit, 0x1p-52 * (origin + r).norm());
    }
    ASSERT_LT(sum.norm(), tolerance * total) << "row " << p;
    ASSERT_LT((identity - Mat2::Identity()).norm(), tolerance * scale + 10 * last_bit * total) << "row " << p;
  }
}

void expect_interior_free_of_force(const Cloud<2>& cloud, const DiscreteOperators<2>& op) {
  std::vector<bool> boundary(cloud.position.size(), false);
  for (const auto& facet : cloud.facets) boundary[static_cast<std::size_t>(facet.node[0])] = true;
  for (std::size_t j = 0; j < cloud.position.size(); ++j) {
    if (boundary[j]) continue;
    Vec2 force = Vec2::Zero();
    double scale = 0.0;
    for (auto e = static_cast<std::size_t>(op.col_begin[j]);
         e < static_cast<std::size_t>(op.col_begin[j + 1]); ++e) {
      const Vec2 f(op.weighted_gradient[0][e], op.weighted_gradient[1][e]);
      force += f;
      scale += f.norm();
    }
    ASSERT_LT(force.norm(), tolerance * scale) << "node " << j;
  }
}

class AdversarialOperators : public ::testing::TestWithParam<int> {};

TEST_P(AdversarialOperators, patch_linear_fields_are_exact) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const RandomCloud random = random_cloud(GetParam(), seed);
    SCOPED_TRACE(random.name + ", seed " + std::to_string(seed));
    for (const int points : {1, 2}) {
      const auto approximation = scni::Cnem({Functions::sibson, points}).rebuild(random.cloud);
      expect_linear_fields_reproduced(random.cloud, approximation.mechanics);
      expect_interior_free_of_force(random.cloud, approximation.mechanics);
    }
    const auto laplace = scni::Cnem({Functions::laplace, 1}).rebuild(random.cloud).mechanics;
    expect_linear_fields_reproduced(random.cloud, laplace);
    expect_interior_free_of_force(random.cloud, laplace);
    const auto squares = scni::Cnem({.gauss_points = 1, .support = 2.5}).rebuild(random.cloud).mechanics;
    expect_linear_fields_reproduced(random.cloud, squares);
    expect_interior_free_of_force(random.cloud, squares);
    const auto triangles = methods::FeTriangles().rebuild(random.cloud).mechanics;
    expect_linear_fields_reproduced(random.cloud, triangles);
    expect_interior_free_of_force(random.cloud, triangles);
  }
}

INSTANTIATE_TEST_SUITE_P(families, AdversarialOperators, ::testing::Range(0, families()));

} // namespace
} // namespace cnem::voronoi::test
