// A pulse in an elastic bar against d'Alembert's solution.
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

double pulse(double s) { return std::exp(-s * s); }

/// Relative L2 error of v_x after the pulse has split and travelled a quarter of the bar, lateral motion
/// held.
double pulse_error(Method method, double h, double& residual) {
  const double length = 4e-2, width = 3e-3, centre = 2e-2, half_width = 4e-3, v0 = 1.0;
  Cloud<2> cloud = rectangle(length, width, h, Lattice::hexagonal, 0.1);
  std::vector<NodeIndex> all(static_cast<std::size_t>(cloud.nodes()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = as<NodeIndex>(i);
  Problem<2> model = model_of(cloud, method, steel());
  model.supports = Supports<2>({{"lateral", Support<2>::Kind::symmetry, Vec2(0, 1), {}, all}}, all.size());
  const plasticity::Material material = model.materials.front();
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {v0 * pulse((x.x() - centre) / half_width), 0.0};
  });
  const double c = material.elasticity.dilatational_speed(material.density), end = 0.25 * length / c;
  const int steps = static_cast<int>(std::ceil(end / solver.stable_step().dt));
  const double dt = end / steps;
  for (int n = 0; n < steps; ++n) solver.advance(dt);
  const State<2>& state = solver.state();
  const double t = state.time - 0.5 * dt; // velocities live half a step back
  double error = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const double X = solver.state().node.initial_position[0][i];
    const double exact =
        0.5 * v0 * (pulse((X - c * t - centre) / half_width) + pulse((X + c * t - centre) / half_width));
    const double d = state.node.velocity[0][i] - exact;
    error += state.node.mass[i] * d * d;
    norm += state.node.mass[i] * exact * exact;
  }
  const EnergyLedger ledger = solver.ledger();
  residual = std::abs(ledger.residual()) / ledger.initial();
  return std::sqrt(error / norm);
}

class Waves : public ::testing::TestWithParam<Method> {};

TEST_P(Waves, pulse_follows_dalembert_and_converges) {
  double residual = 0.0;
  const double coarse = pulse_error(GetParam(), 0.8e-3, residual);
  EXPECT_LT(pulse_error(GetParam(), 0.4e-3, residual), 0.02);
  const double fine = pulse_error(GetParam(), 0.2e-3, residual);
  EXPECT_LT(fine, 0.005);
  EXPECT_GT(0.5 * std::log2(coarse / fine), 1.8);
  EXPECT_LT(residual, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(methods, Waves, ::testing::Values(Method::cnem, Method::triangles));

} // namespace
} // namespace cnem::testing
