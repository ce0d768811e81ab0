// What an explicit step must keep: energy, linear and angular momentum.
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

class Conservation : public ::testing::TestWithParam<Method> {};

TEST_P(Conservation, spinning_block_keeps_energy_and_momenta) {
  const Cloud<2> cloud = rectangle(1e-2, 1e-2, 1e-3);
  const double omega = 2e4; // rad/s: 100 m/s at the corners, two turns
  const Vec2 drift(30.0, -10.0);
  ExplicitSolver<2> solver = start(model_of(cloud, GetParam(), steel()), [&](const Vec2& x) -> Vec2 {
    return drift + omega * left_normal(x - Vec2(5e-3, 5e-3));
  });
  const double dt = solver.stable_step().dt;
  solver.advance(dt);
  const Momenta before = momenta(solver);
  const double energy = solver.ledger().initial();
  double worst = 0.0;
  const int steps = static_cast<int>(4.0 * 3.14159 / omega / dt);
  for (int n = 0; n < steps; ++n) {
    solver.advance(dt);
    if (n % 50 == 0) worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  const Momenta after = momenta(solver);
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  const double scale = mass * omega * 5e-3;
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * scale * 10);
  EXPECT_NEAR(after.angular, before.angular, 1e-11 * scale * 1e-2);
  EXPECT_LT(worst, 1e-4 * energy);
}

TEST_P(Conservation, plastic_impact_closes_the_ledger) {
  Cloud<2> cloud = rectangle(4e-3, 8e-3, 4e-4);
  std::vector<Support<2>> wall{
      {"wall", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(cloud, 0_piece)}};
  Problem<2> model = model_of(cloud, GetParam(), steel_304L());
  model.supports = Supports<2>(std::move(wall), static_cast<std::size_t>(cloud.nodes()));
  model.viscosity = {1.2, 0.06};
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0.0, -150.0}; });
  double worst = 0.0, dt = 0.0;
  for (int n = 0; n < 1500; ++n) {
    if (n % 10 == 0) dt = solver.stable_step().dt;
    solver.advance(dt);
    worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  EXPECT_GT(solver.ledger()["plastic"], 0.5 * solver.ledger().initial());
  EXPECT_LT(worst, 2e-3 * solver.ledger().initial());
}

INSTANTIATE_TEST_SUITE_P(methods, Conservation,
                         ::testing::Values(Method::cnem, Method::triangles, Method::sph, Method::hybrid));

} // namespace
} // namespace cnem::testing
