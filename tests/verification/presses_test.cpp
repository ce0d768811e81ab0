// Tools with a mass of their own, with the whole solver, against exact solutions.
#include "tests/unit/mechanics/graded.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

contact::Tool<2> ram(const Vec2& low, const Vec2& high, double mass, const Vec2& velocity,
                     std::array<TimeTable, 2> force = {}) {
  contact::Tool<2> tool = rigid_tool("ram", box(low, high));
  tool.drive = contact::ToolDrive<2>{mass, std::move(force), velocity};
  return tool;
}

/// Steel without lateral strain: bars are one-dimensional, c = √(E/ρ).
plasticity::Material rod() {
  plasticity::Material material = steel();
  material.elasticity.poisson = 0.0;
  return material;
}

Vec2 ram_velocity(const ExplicitSolver<2>& solver) {
  return solver.conditions().contact.velocity(0, solver.state().time);
}

/// A long bar that a ram hits at x = 0, until the wave is back from the far end: m dv/dt = −ρ c A v.
void expect_exponential(Problem<2> model, double length, double width) {
  const bool local = model.local.on;
  const double speed = 5.0;
  const plasticity::Material material = rod();
  const double c = material.elasticity.bar_speed(material.density);
  const double mass = 0.3 * material.density * length * width;
  model.contact = contact::RigidContact<2>({ram({-1e-2, -1e-2}, {0.0, 1e-2}, mass, {speed, 0})});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt, momentum = mass * speed;
  double worst = 0.0;
  while (solver.state().time < 1.8 * length / c) {
    solver.advance(dt);
    const double t = solver.state().time - 0.5 * dt / solver.sub_steps();
    const double exact = speed * std::exp(-material.density * c * width * t / mass);
    worst = std::max(worst, std::abs(ram_velocity(solver).x() - exact));
    EXPECT_NEAR(momenta(solver).linear.x() + mass * ram_velocity(solver).x(), momentum, 1e-12 * momentum);
  }
  EXPECT_EQ(solver.sub_steps() > 1, local);
  EXPECT_LT(worst, 0.012 * speed);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_NEAR(ledger.initial(), 0.5 * mass * speed * speed, 1e-12 * ledger.initial());
  EXPECT_LT(std::abs(ledger.residual()), 1e-3 * ledger.initial());
  EXPECT_LT(std::abs(ledger.external()), 1e-12 * ledger.initial());
}

class Hammer : public ::testing::TestWithParam<Method> {};

TEST_P(Hammer, that_hits_a_long_bar_is_slowed_exponentially_by_its_impedance) {
  const double length = 2e-2, width = 1e-3;
  expect_exponential(model_of(rectangle(length, width, 1.25e-4, Lattice::square, 0.0), GetParam(), rod()),
                     length, width);
}
INSTANTIATE_TEST_SUITE_P(methods, Hammer, ::testing::Values(Method::cnem, Method::triangles));

TEST(Hammer, is_slowed_by_a_bar_with_local_steps) {
  const double length = 2e-2, width = 1e-3;
  Problem<2> model =
      model_of(graded_rectangle(length, width, 1.6e-4, 4e-5, {{0, 0}, {0, width}}), Method::cnem, rod());
  model.local = {.on = true, .least_gain = 0.0};
  expect_exponential(std::move(model), length, width);
}

TEST(Hammer, bounces_off_a_free_block_with_the_momentum_and_energy_they_had) {
  for (const auto& [ratio, local] : {std::pair(5.0, false), {0.05, false}, {5.0, true}, {0.05, true}}) {
    Problem<2> model = model_of(local ? graded_rectangle(2e-3, 1e-3, 1e-4, 2e-5, {{1e-3, 1e-3}})
                                      : rectangle(2e-3, 1e-3, 1e-4),
                                Method::cnem, steel());
    model.local = {.on = local, .least_gain = 0.0};
    const double mass = ratio * 7850.0 * 2e-6, speed = 3.0;
    model.contact = contact::RigidContact<2>({ram({0.4e-3, 1.02e-3}, {1.6e-3, 2e-3}, mass, {0.0, -speed})});
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
    const double dt = solver.stable_step().dt, momentum = mass * speed;
    for (int n = 0; n < 3000 / solver.sub_steps(); ++n) {
      solver.advance(dt);
      const Vec2 sum = momenta(solver).linear + mass * ram_velocity(solver);
      ASSERT_LT((sum - Vec2(0, -momentum)).norm(), 1e-12 * momentum) << "step " << n;
    }
    EXPECT_EQ(solver.conditions().contact.points().size(), 0U) << "they have parted";
    const double block = momenta(solver).linear.y() / total_mass(solver);
    EXPECT_GT(ram_velocity(solver).y(), block);
    const EnergyLedger ledger = solver.ledger();
    // what a light ram strikes rings at the borders of levels
    EXPECT_LT(std::abs(ledger.residual()), (local && ratio < 1.0 ? 1e-2 : 1e-3) * ledger.initial());
    const double layer = 7850.0 * 1.2e-3 * 0.5e-4; // of nodes that meet the ram at once, inelastically
    EXPECT_LT(ledger["contact_impact"], 1.3 * layer / (layer + mass) * ledger.initial());
    EXPECT_NEAR(ledger["tool_kinetic"], 0.5 * mass * ram_velocity(solver).squaredNorm(),
                1e-12 * ledger.initial());
  }
}

TEST(ForcePress, comes_to_rest_where_an_elastic_block_carries_its_force) {
  const double width = 2e-3, height = 1e-3, force = 4e5;
  for (const double mass : {0.1, 1e-6}) { // kg/m: the block weighs 0.0157, a node on its top 4e-4
    Cloud<2> cloud = rectangle(width, height, 2e-4);
    Problem<2> model = model_of(std::move(cloud), Method::cnem, rod());
    model.supports =
        Supports<2>({{"base", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(model.cloud, 0_piece)}},
                    static_cast<std::size_t>(model.cloud.nodes()));
    model.viscosity = {1.2, 1.0};
    std::vector<double> time, value; // from 0 to F without a kink
    for (int k = 0; k <= 50; ++k) {
      const double s = k / 50.0;
      time.push_back(s * 4e-5);
      value.push_back(-force * s * s * (3.0 - 2.0 * s));
    }
    model.contact = contact::RigidContact<2>(
        {ram({-1e-3, height}, {3e-3, 2e-3}, mass, {0, 0}, {TimeTable(), TimeTable(time, value)})});
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
    const double dt = solver.stable_step().dt;
    while (solver.state().time < 1e-4) solver.advance(dt);
    const double strain =
        force / (width * 210e9); // logarithmic, in Kirchhoff measure: 1e-3 apart from Cauchy
    const auto& contact = solver.conditions().contact;
    EXPECT_NEAR(contact.displacement(0, 0.0).y(), -height * strain, 2e-3 * height * strain) << mass;
    EXPECT_NEAR(contact.results()[0].force.y(), -force, 5e-3 * force) << mass;
    EXPECT_NEAR(solver.ledger()["drive_work"], 0.5 * force * height * strain, 0.02 * force * height * strain)
        << mass;
    EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger()["drive_work"]) << mass;
  }
}

/// A punch below a slide, with a frame between them that is as stiff as the block: each takes half of the
/// way.
TEST(SprungPress, shares_the_stroke_of_its_slide_with_the_block) {
  const double width = 2e-3, height = 1e-3, stiffness = 210e9 * width / height, stroke = 2e-6;
  Problem<2> model = model_of(rectangle(width, height, 2e-4), Method::cnem, rod());
  model.supports =
      Supports<2>({{"base", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(model.cloud, 0_piece)}},
                  static_cast<std::size_t>(model.cloud.nodes()));
  model.viscosity = {1.2, 1.0};
  model.sprung_tools = true;
  contact::Tool<2> punch = ram({-1e-3, height}, {3e-3, 2e-3}, 0.1, {0, 0});
  contact::LinearSpring frame;
  frame.stiffness = stiffness;
  punch.drive->free = Vec2(0, 1) * Vec2(0, 1).transpose();
  punch.drive->spring = contact::ToolSpring<2>{frame, {0, -1}};
  punch.drive->damping = 0.2 * std::sqrt(stiffness * 0.1);
  punch.motion.velocity[1] = TimeTable({0.0, 2e-5, 4e-5}, {0.0, -stroke / 2e-5, 0.0});
  model.contact = contact::RigidContact<2>({punch});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt;
  double worst = 0.0;
  while (solver.state().time < 1.2e-4) {
    solver.advance(dt);
    worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  const auto& contact = solver.conditions().contact;
  const double force = 0.5 * stroke * stiffness, stored = 0.25 * force * stroke;
  EXPECT_NEAR(contact.displacement(0, 0.0).y(), -0.5 * stroke, 2e-3 * stroke);
  EXPECT_NEAR(contact.results()[0].force.y(), -force, 5e-3 * force);
  EXPECT_NEAR(contact.spring_force(0, solver.state().time), force, 5e-3 * force);
  const EnergyLedger ledger = solver.ledger();
  EXPECT_NEAR(ledger["tool_springs"], stored, 1e-2 * stored);
  EXPECT_NEAR(ledger["elastic"], stored, 1e-2 * stored);
  EXPECT_GT(ledger["tool_damping"], 0.0);
  EXPECT_LT(worst, 2e-3 * ledger["drive_work"]);
}

TEST(SprungPress, that_is_light_shortens_the_step) {
  Problem<2> model = model_of(rectangle(2e-3, 1e-3, 2e-4), Method::cnem, rod());
  contact::Tool<2> punch = ram({-1e-3, 2e-3}, {3e-3, 3e-3}, 1e-6, {0, 0});
  contact::LinearSpring frame;
  frame.stiffness = 1e11;
  punch.drive->spring = contact::ToolSpring<2>{frame, {0, -1}};
  model.contact = contact::RigidContact<2>({punch});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const auto step = solver.stable_step();
  EXPECT_EQ(step.limit, "springs of tools");
  EXPECT_NEAR(step.dt, 0.9 * 2.0 * std::sqrt(1e-6 / 1e11), 1e-6 * step.dt);
}

} // namespace
} // namespace cnem::testing
