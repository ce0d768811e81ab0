// Conduction acts once in several steps of motion, over all of their time.
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr double length = 2e-3, width = 2e-4, h = 1e-4;

/// A strip at rest with T = 300 + 10 cos(π X/L), of a conductor whose fastest mode is `ratio` steps of
/// motion.
ExplicitSolver<2> conducting(double ratio, double& rate) {
  Problem<2> model = model_of(rectangle(length, width, h), Method::cnem, steel());
  model.thermal = true;
  plasticity::Material& material = model.materials.front();
  const double speed =
      std::sqrt((material.elasticity.lambda() + 2.0 * material.elasticity.mu()) / material.density);
  const double diffusivity = 0.25 * h * speed / ratio; // h²/4κ = ratio h/c
  material.conductivity = diffusivity * material.density * material.specific_heat;
  rate = diffusivity * std::numbers::pi * std::numbers::pi / (length * length);
  Field temperature(model.cloud.position.size());
  for (std::size_t i = 0; i < temperature.size(); ++i)
    temperature[i] = 300.0 + 10.0 * std::cos(std::numbers::pi * model.cloud.position[i].x() / length);
  Fields<2> velocity;
  resize_all(velocity, temperature.size());
  return {std::move(model), std::move(velocity), std::move(temperature)};
}

/// Σ C T cos(π X/L) over Σ C cos²: the amplitude of the slowest mode, K.
double amplitude(const ExplicitSolver<2>& solver) {
  const NodeState<2>& node = solver.state().node;
  double sum = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const double mode = std::cos(std::numbers::pi * node.initial_position[0][i] / length);
    sum += node.heat_capacity[i] * node.temperature[i] * mode;
    norm += node.heat_capacity[i] * mode * mode;
  }
  return sum / norm;
}

TEST(ConductionInterval, keeps_heat_and_the_decay_of_a_mode) {
  double rate = 0.0;
  ExplicitSolver<2> solver = conducting(2000.0, rate);
  const double dt = solver.stable_step().dt, start = amplitude(solver);
  const int steps = 16 * static_cast<int>(std::ceil(0.2 / (16.0 * rate * dt)));
  for (int n = 0; n < steps; ++n) solver.advance(dt);
  EXPECT_NEAR(std::log(start / amplitude(solver)), rate * dt * steps, 0.005 * rate * dt * steps);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_NEAR(ledger["heat_content"], 0.0, 1e-9 * total_mass(solver) * 500.0 * 10.0);
}

TEST(ConductionInterval, is_sixteen_steps_or_a_hundredth_of_the_stable_one) {
  for (const auto& [ratio, interval] : {std::pair{1e5, 16}, std::pair{20.0, 1}}) {
    double rate = 0.0;
    ExplicitSolver<2> solver = conducting(ratio, rate);
    const double dt = solver.stable_step().dt;
    const Field before = solver.state().node.temperature;
    for (int n = 1; n < interval; ++n) solver.advance(dt);
    EXPECT_EQ(solver.state().node.temperature, before);
    solver.advance(dt);
    EXPECT_NE(solver.state().node.temperature, before);
  }
}

} // namespace
} // namespace cnem::testing
