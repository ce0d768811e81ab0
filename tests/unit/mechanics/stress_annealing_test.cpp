// Annealing of stresses where metal has ceased to flow: what it conserves, books and rubs out.
#include "graded.hpp"
#include "mechanics/terms/stress_annealing.hpp"
#include "models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

TEST(StressAnnealing, is_as_much_however_often_references_are_renewed) {
  const double flowed = 2e-6, end = 1.4e-5;
  double often = 0.0, seldom = 0.0;
  for (int n = 1; n <= 1400; ++n) often += annealing_due(1e-8 * n, 1e-8, flowed);
  for (int n = 1; n <= 7; ++n) seldom += annealing_due(2e-6 * n, 2e-6, flowed);
  EXPECT_NEAR(often, seldom, 1e-10 * often);
  EXPECT_NEAR(often, 100.0 * (1.0 - std::exp(-end / (3.0 * flowed))), 1e-10 * often);
  EXPECT_EQ(annealing_due(16.0 * flowed, 1e-7, flowed), 0.0);
  EXPECT_EQ(annealing_due(1e-7, 1e-7, 0.0), 0.0);
}

/// A block, or a ring of its section, that was set in motion, flows and comes to rest.
ExplicitSolver<2> stirred(double annealing, Space space = Space::plane, bool local = false) {
  Cloud<2> cloud = local ? graded_rectangle(2e-3, 1e-3, 1.2e-4, 3e-5, {{0.9e-3, 5e-4}, {1.1e-3, 5e-4}})
                         : rectangle(2e-3, 1e-3, 1e-4);
  if (space == Space::revolution)
    for (Vec2& at : cloud.position) at.x() += 3e-3;
  Problem<2> model = model_of(std::move(cloud), Method::cnem, steel_304L());
  model.method = make(Method::cnem, space);
  model.stress_annealing = annealing;
  model.viscosity = {1.2, 0.06};
  model.local = {.on = local, .least_gain = 0.0};
  return start(std::move(model), [](const Vec2& x) -> Vec2 {
    return {60.0 * std::sin(2000.0 * x.y()), -80.0 * std::sin(1500.0 * x.x())};
  });
}

/// On references renewed every 100 steps.
void run(ExplicitSolver<2>& solver, int steps) {
  const double dt = 0.8 * solver.stable_step().dt;
  for (int n = 0; n < steps; ++n) {
    if (n % 100 == 99) solver.prepare();
    solver.advance(dt);
  }
}

TEST(StressAnnealing, keeps_momenta_and_the_energy_balance_of_a_run) {
  for (const double strength : {0.0, 1.0}) {
    ExplicitSolver<2> solver = stirred(strength);
    const Momenta before = momenta(solver);
    run(solver, 1500);
    const Momenta after = momenta(solver);
    const double scale = 2e-6 * 7850.0 * 80.0, initial = solver.ledger().initial();
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * scale) << strength;
    EXPECT_LT(std::abs(after.angular - before.angular), 1e-12 * scale * 1e-3) << strength;
    const EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger["plastic"], 0.1 * initial);
    EXPECT_LT(std::abs(ledger.residual()), 1e-3 * initial) << strength;
    if (strength == 0.0) continue;
    EXPECT_GT(ledger["stress_annealing"], 0.0);
  }
}

TEST(StressAnnealing, balances_of_revolution_and_with_local_steps) {
  for (const bool local : {false, true}) {
    ExplicitSolver<2> solver = stirred(1.0, local ? Space::plane : Space::revolution, local);
    run(solver, local ? 600 : 1500);
    EXPECT_EQ(solver.sub_steps() > 1, local);
    const EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger["plastic"], 0.1 * ledger.initial());
    EXPECT_GT(ledger["stress_annealing"], 0.0);
    EXPECT_LT(std::abs(ledger.residual()), 2e-3 * ledger.initial()) << local;
  }
}

TEST(StressAnnealing, takes_frozen_noise_away) {
  double without = 0.0;
  for (const double strength : {0.0, 1.0}) {
    ExplicitSolver<2> solver = stirred(strength);
    run(solver, 1500);
    const PointState<2>& point = solver.state().point;
    const StabilisationLinks<2>& links = solver.approximation().links;
    double sum = 0.0;
    for (std::size_t i = 0; i < point.size(); ++i) {
      double mean = 0.0;
      for (std::int32_t e = links.begin[i]; e < links.begin[i + 1]; ++e)
        mean += point.pressure[std::size_t(links.neighbour[std::size_t(e)])];
      mean /= links.begin[i + 1] - links.begin[i];
      sum += std::pow(point.pressure[i] - mean, 2);
    }
    if (strength == 0.0)
      without = sum;
    else
      EXPECT_LT(sum, 0.4 * without);
  }
}

} // namespace
} // namespace cnem::testing
