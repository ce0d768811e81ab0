// Lamé's hollow sphere under pressure, an eighth, against the exact displacements, near incompressibility
// too.
#include "app/statics/static_model.hpp"
#include "core/fields/vector_at.hpp"
#include "input/case_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace cnem::testing {
namespace {

struct Solved {
  std::size_t nodes = 0;
  double inside = 0.0; ///< mean of u_r over the exact one on the inner face, less 1
  double error = 0.0;  ///< ‖u − u_exact‖ over ‖u_exact‖
};

Solved solve(const std::vector<std::string>& method, double poisson, const std::string& spacing) {
  std::vector<std::string> set = method;
  set.push_back("materials.steel.elastic.poisson=" + std::to_string(poisson));
  set.push_back("cloud.spacing=" + spacing);
  const input::Case input = input::read_case(CNEM_SOURCE_DIR "/cases/three_dimensions/sphere/case.toml", set);
  const app::StaticModel<3> model(input);
  const StaticSolution<3> solution = solve_statics(model.problem());
  constexpr double E = 210e9, p = 100e6, a = 10e-3, b = 20e-3;
  const auto exact = [&](double r) {
    return p * a * a * a / (E * (b * b * b - a * a * a)) *
           ((1.0 - 2.0 * poisson) * r + (1.0 + poisson) * b * b * b / (2.0 * r * r));
  };
  Solved result;
  result.nodes = model.position[0].size();
  double error = 0.0, scale = 0.0, sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < result.nodes; ++i) {
    const Vec<3> x = input.origin + vector_at<3>(model.position, i);
    const double r = x.norm(), volume = model.approximation.node_volume[i];
    const Vec<3> u = vector_at<3>(solution.displacement, i), wanted = exact(r) * x / r;
    error += volume * (u - wanted).squaredNorm();
    scale += volume * wanted.squaredNorm();
    if (std::abs(r - a) > 1e-9) continue;
    sum += u.dot(x) / (r * exact(r));
    count += 1.0;
  }
  result.inside = sum / count - 1.0;
  result.error = std::sqrt(error / scale);
  return result;
}

const std::vector<std::string> median{"method.cells=\"median\""},
    laplace{"method.cells=\"voronoi\"", "method.functions=\"laplace\""},
    tetrahedra{"method.name=\"fe-tetrahedra\""};

class HollowSphere : public ::testing::TestWithParam<std::vector<std::string>> {};

TEST_P(HollowSphere, converges_with_the_order_of_linear_functions_though_nearly_incompressible) {
  constexpr double poisson = 0.4999;
  const Solved coarse = solve(GetParam(), poisson, "2.43 mm"), medium = solve(GetParam(), poisson, "1.9 mm"),
               fine = solve(GetParam(), poisson, "1.55 mm");
  EXPECT_LE(coarse.nodes, 462U);
  EXPECT_LE(fine.nodes, 1683U);
  EXPECT_LT(std::abs(coarse.inside), 0.045) << coarse.inside;
  EXPECT_LT(std::abs(fine.inside), 0.02) << fine.inside;
  EXPECT_LT(medium.error, coarse.error);
  EXPECT_GT(std::log(coarse.error / fine.error) / std::log(2.43 / 1.55), 1.8)
      << coarse.error << " " << medium.error << " " << fine.error;
}

TEST_P(HollowSphere, of_steel_is_within_its_tolerance_on_a_coarse_cloud) {
  EXPECT_LT(std::abs(solve(GetParam(), 0.3, "2.43 mm").inside), 0.045);
}

INSTANTIATE_TEST_SUITE_P(cells, HollowSphere, ::testing::Values(median, laplace),
                         [](const auto& run) { return run.index == 0 ? "median" : "voronoi"; });

// What nodal integration is for.
TEST(HollowSphereOfTetrahedra, they_lock) {
  EXPECT_LT(solve(tetrahedra, 0.4999, "2.43 mm").inside, -0.9);
  EXPECT_GT(solve(tetrahedra, 0.3, "2.43 mm").inside, -0.08);
}

} // namespace
} // namespace cnem::testing
