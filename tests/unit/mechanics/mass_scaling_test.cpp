// Mass scaling: longer steps, inertia alone, the same forces in slow processes.
#include "tests/unit/mechanics/tools.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

TEST(MassScaling, lengthens_the_step_by_the_root_of_its_factor_and_leaves_weight_alone) {
  const double factor = 16.0, gravity = 1e4;
  double step = 0.0;
  for (const double scale : {1.0, factor}) {
    Problem<2> model = model_of(rectangle(2e-3, 1e-3, 2e-4), Method::cnem, steel());
    model.mass_scaling.factor = scale;
    model.loads = Loads<2>({}, {}, {TimeTable(), TimeTable(-gravity)}, model.cloud.position);
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
    const double dt = solver.stable_step().dt;
    if (step > 0.0) { EXPECT_NEAR(dt, step * std::sqrt(factor), 1e-12 * dt); }
    step = dt;
    for (int n = 0; n < 20; ++n) solver.advance(1e-8);
    solver.prepare();
    for (int n = 0; n < 20; ++n) solver.advance(1e-8);
    const double fall = momenta(solver).linear.y(); // of the mass; the inertia has `scale` times that
    double mass = 0.0, capacity = 0.0;
    for (const double m : solver.state().node.mass) mass += m;
    for (const double c : solver.state().node.heat_capacity) capacity += c;
    EXPECT_NEAR(mass, 7850.0 * 2e-6, 1e-12 * mass);
    EXPECT_NEAR(capacity, mass * 500.0, 1e-12 * capacity);
    EXPECT_NEAR(fall, -mass * gravity / scale * 39.5e-8, 1e-10 * mass * gravity * 4e-7);
    EXPECT_LT(std::abs(solver.ledger().residual()), 1e-12 * mass * gravity * gravity * 1.6e-13);
  }
}

class StepWanted : public ::testing::TestWithParam<Space> {};

TEST_P(StepWanted, makes_only_the_nodes_heavier_that_limit_it) {
  // a cluster of small cells in a block of larger ones
  Cloud<2> cloud = rectangle(4e-3, 2e-3, 2.5e-4, Lattice::square, 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) cloud.position.push_back({2.07e-3 + 0.05e-3 * i, 1.07e-3 + 0.05e-3 * j});
  const auto build = [&](double step) {
    Problem<2> model = model_of(cloud, Method::cnem, steel());
    model.method = make(Method::cnem, GetParam());
    model.mass_scaling.step = step;
    return start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  };
  ExplicitSolver<2> plain = build(0.0);
  const double before = plain.stable_step().dt, wanted = 1.5 * before;
  ExplicitSolver<2> scaled = build(wanted);
  EXPECT_GE(scaled.stable_step().dt, wanted * (1.0 - 1e-12));
  EXPECT_LE(scaled.stable_step().dt, wanted * 1.02) << "no heavier than it must be";
  std::size_t heavier = 0;
  for (std::size_t i = 0; i < scaled.state().node.inertia().size(); ++i) {
    const double ratio = scaled.state().node.inertia()[i] / scaled.state().node.mass[i];
    EXPECT_GE(ratio, 1.0);
    EXPECT_LE(ratio, 4.0 * (1.0 + 1e-12));
    const double away = (cloud.position[i] - Vec2(2.12e-3, 1.12e-3)).norm();
    if (ratio > 1.0) ++heavier;
    if (away > 8e-4 && GetParam() == Space::plane) { EXPECT_EQ(ratio, 1.0) << away; }
  }
  EXPECT_GT(heavier, 4U);
  EXPECT_LT(heavier, scaled.state().node.inertia().size() / 2);
  EXPECT_EQ(plain.state().node.inertia(), plain.state().node.mass);
  EXPECT_EQ(plain.wanted_step(), 0.0);
}

/// Square cells of a spacing have the step that is asked for by it, but for the stabilisation.
TEST(MassScaling, by_spacing_is_that_of_the_step_of_square_cells) {
  constexpr double spacing = 1e-4;
  Problem<2> model = model_of(rectangle(2e-3, 2e-3, spacing, Lattice::square, 0.0), Method::cnem, steel());
  model.mass_scaling.cell = spacing;
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double wanted = solver.wanted_step();
  const plasticity::Material& metal = solver.model().materials.front();
  const double speed = std::sqrt((metal.elasticity.lambda() + 2.0 * metal.elasticity.mu()) / metal.density);
  EXPECT_NEAR(wanted, 2.0 * solver.model().safety * spacing / speed, 1e-12 * wanted);
  EXPECT_NEAR(solver.stable_step().dt, wanted, 0.05 * wanted);
}
INSTANTIATE_TEST_SUITE_P(Of, StepWanted, ::testing::Values(Space::plane, Space::revolution),
                         [](const auto& space) {
                           return space.param == Space::plane ? "plane" : "revolution";
                         });

/// A block upset by a plate from 1 to 0.93 mm: mean force over the last quarter, kinetic over deformation
/// energy, largest temperature, number of steps.
struct Upset {
  double force = 0.0, kinetic_share = 0.0, temperature = 0.0;
  int steps = 0;
};
Upset upset(const MassScaling& scaling) {
  const double end = 1e-4;
  contact::Tool<2> tool = rigid_tool("plate", box({-1e-3, 1e-3}, {3e-3, 2e-3}));
  tool.motion.velocity[1] = TimeTable({0.0, 0.3 * end, 0.5 * end}, {0.0, -0.4, -1.0});
  Problem<2> model = model_of(rectangle(2e-3, 1e-3, 2e-4), Method::cnem, steel_304L());
  model.supports =
      Supports<2>({{"base", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(model.cloud, 0_piece)}},
                  static_cast<std::size_t>(model.cloud.nodes()));
  model.contact = contact::RigidContact<2>({tool});
  model.mass_scaling = scaling;
  model.viscosity = {1.2, 0.06};
  model.thermal = true;
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt;
  Upset result;
  double time = 0.0;
  while (solver.state().time < end) {
    solver.advance(dt);
    ++result.steps;
    if (solver.state().time < 0.75 * end) continue;
    result.force += dt * solver.conditions().contact.results()[0].force.y();
    time += dt;
  }
  result.force /= time;
  const EnergyLedger ledger = solver.ledger();
  EXPECT_LT(std::abs(ledger.residual()), 1e-3 * ledger.external());
  EXPECT_LT(std::abs(ledger.heat_residual()), 1e-9 * ledger["heat_generated"]);
  result.kinetic_share = ledger.kinetic_share();
  const Field& temperature = solver.state().node.temperature;
  result.temperature = *std::max_element(temperature.begin(), temperature.end());
  return result;
}

TEST(MassScaling, of_a_slow_compression_keeps_its_force_and_heat) {
  const Upset plain = upset({});
  for (const double factor : {25.0, 100.0}) {
    const Upset scaled = upset({.factor = factor});
    EXPECT_NEAR(scaled.force, plain.force, 5e-3 * std::abs(plain.force)) << factor;
    EXPECT_NEAR(scaled.temperature - 296.0, plain.temperature - 296.0, 0.02 * (plain.temperature - 296.0));
    EXPECT_LT(scaled.kinetic_share, 0.05);
    EXPECT_LT(scaled.steps, 1.2 * plain.steps / std::sqrt(factor));
    EXPECT_NEAR(scaled.kinetic_share, factor * plain.kinetic_share, 0.1 * scaled.kinetic_share);
  }
}

} // namespace
} // namespace cnem::testing
