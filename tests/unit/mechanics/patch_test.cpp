// The affine patch test: a boundary moved by x = A X must carry the interior along, with uniform stress.
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

class Patch : public ::testing::TestWithParam<Method> {};

/// All boundary nodes follow X → X + s(t) H X; the interior starts with the matching velocity.
ExplicitSolver<2> driven(Method method, const Mat2& H, double end, plasticity::Material material) {
  Cloud<2> cloud = rectangle(1e-2, 0.8e-2, 1e-3, Lattice::hexagonal, 0.2);
  std::vector<Support<2>> supports;
  for (const NodeIndex i : IndexRange<NodeIndex>(cloud.facets.size()))
    for (int k = 0; k < 2; ++k) {
      const double speed = H.row(k).dot(cloud.position[i]) / end;
      supports.push_back(
          {"side", Support<2>::Kind::velocity, k == 0 ? Vec2(1, 0) : Vec2(0, 1), TimeTable(speed), {i}});
    }
  Problem<2> model = model_of(cloud, method, std::move(material));
  model.supports = Supports<2>(std::move(supports), static_cast<std::size_t>(cloud.nodes()));
  return start(std::move(model), [&](const Vec2& x) -> Vec2 { return H * x / end; });
}

void expect_affine(const ExplicitSolver<2>& solver, const Mat2& F) {
  const State<2>& state = solver.state();
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const Vec2 X(solver.state().node.initial_position[0][i], solver.state().node.initial_position[1][i]);
    const Vec2 x(state.node.position[0][i], state.node.position[1][i]);
    EXPECT_LT((x - F * X).norm(), 1e-13) << "node " << i;
  }
  for (std::size_t p = 1; p < state.point.size(); ++p)
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(state.point.piola[k][p], state.point.piola[k][0], 1e-9 * 210e9) << "point " << p;
}

TEST_P(Patch, large_stretch_and_shear_stays_affine) {
  Mat2 H;
  H << 0.5, 0.7, -0.2, -0.3;
  const double end = 2e-5;
  ExplicitSolver<2> solver = driven(GetParam(), H, end, steel());
  const int steps = 400;
  for (int n = 0; n < steps; ++n) solver.advance(end / steps);
  expect_affine(solver, Mat2::Identity() + H);
}

TEST_P(Patch, plastic_flow_stays_affine) {
  Mat2 H;
  H << 0.0, 0.8, 0.0, 0.0;
  const double end = 2e-5;
  ExplicitSolver<2> solver = driven(GetParam(), H, end, steel_304L());
  const int steps = 400;
  for (int n = 0; n < steps; ++n) solver.advance(end / steps);
  expect_affine(solver, Mat2::Identity() + H);
  EXPECT_GT(solver.state().point.plastic_strain[0], 0.4);
}

TEST_P(Patch, affine_through_new_references) {
  Mat2 H;
  H << 0.2, 0.5, -0.1, -0.2;
  const double end = 2e-5;
  ExplicitSolver<2> solver = driven(GetParam(), H, end, steel_304L());
  const int steps = 400;
  for (int n = 0; n < steps; ++n) {
    if (n % 50 == 49) solver.prepare();
    solver.advance(end / steps);
  }
  const State<2>& state = solver.state();
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const Vec2 X(solver.state().node.initial_position[0][i], solver.state().node.initial_position[1][i]);
    const Vec2 x(state.node.position[0][i], state.node.position[1][i]);
    EXPECT_LT((x - X - H * X).norm(), 1e-12) << "node " << i;
  }
  EXPECT_EQ(solver.references(), 1 + steps / 50);
}

INSTANTIATE_TEST_SUITE_P(patch, Patch, ::testing::Values(Method::cnem, Method::triangles, Method::hybrid));

} // namespace
} // namespace cnem::testing
