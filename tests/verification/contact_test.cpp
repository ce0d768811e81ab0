// Contact with rigid tools, with the whole solver, against exact solutions.
#include "tests/unit/mechanics/tools.hpp"
#include "tests/verification/bar_impact.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

Mat2 rotation(double angle) {
  Mat2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R;
}

contact::Tool<2> polygon_tool(const std::vector<Vec2>& corners, const Vec2& velocity, double friction) {
  return rigid_tool("tool", polygon(corners), velocity, contact::Coulomb{friction});
}

class Bar : public ::testing::TestWithParam<Method> {};

TEST_P(Bar, against_a_rigid_wall_has_force_rho_c_v_and_duration_2_l_over_c) {
  const double length = 2e-2, width = 1e-3, h = 1.25e-4, speed = 5.0;
  plasticity::Material material = steel();
  material.elasticity.poisson = 0.0; // one-dimensional: c = √(E/ρ) exactly
  Problem<2> model = model_of(rectangle(length, width, h, Lattice::square, 0.0), GetParam(), material);
  model.contact = contact::RigidContact<2>(
      {polygon_tool({{-1e-2, -1e-2}, {0.0, -1e-2}, {0.0, 1e-2}, {-1e-2, 1e-2}}, {0, 0}, 0.0)});
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2&) -> Vec2 { return {-speed, 0}; });
  const double c = material.elasticity.bar_speed(material.density), duration = 2.0 * length / c;
  const double momentum = momenta(solver).linear.x();
  expect_bar_impact(solver, 0.0, duration, material.density * c * speed * width,
                    [&] { return solver.conditions().contact.results()[0].force.x(); });
  const double impulse = solver.conditions().contact.results()[0].impulse.x();
  EXPECT_NEAR(impulse, momenta(solver).linear.x() - momentum, 1e-12 * total_mass(solver) * speed);
  EXPECT_NEAR(momenta(solver).linear.x(), -momentum, 0.02 * std::abs(momentum))
      << "it leaves as fast as it came";
}
INSTANTIATE_TEST_SUITE_P(methods, Bar, ::testing::Values(Method::cnem, Method::triangles));

/// Tangential velocity of an elastic block on a plane with gravity inclined by `angle`, after `time`.
double slide(double angle, double friction, double gravity, double time) {
  Problem<2> model = model_of(rectangle(2e-3, 1e-3, 2.5e-4, Lattice::square, 0.0), Method::cnem, steel());
  model.contact = contact::RigidContact<2>(
      {polygon_tool({{-2e-2, -1e-2}, {2e-2, -1e-2}, {2e-2, 0.0}, {-2e-2, 0.0}}, {0, 0}, friction)});
  model.loads =
      Loads<2>({}, {}, {TimeTable(gravity * std::sin(angle)), TimeTable(-gravity * std::cos(angle))},
               model.cloud.position);
  model.viscosity = {1.2, 0.06};
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt;
  while (solver.state().time < time) solver.advance(dt);
  EXPECT_LT(std::abs(solver.ledger().residual()),
            1e-3 * (solver.ledger().external() + solver.ledger()["friction"]));
  return momenta(solver).linear.x() / total_mass(solver);
}

TEST(Incline, slides_with_coulomb_acceleration_and_sticks_below_the_friction_angle) {
  const double g = 1e5, time = 2e-4;
  for (const double angle : {0.3, 0.6, 0.9})
    for (const double mu : {0.0, 0.1, 0.25}) {
      const double exact = g * (std::sin(angle) - mu * std::cos(angle)) * time;
      EXPECT_NEAR(slide(angle, mu, g, time), exact, 0.02 * g * time) << "angle " << angle << " mu " << mu;
    }
  const double threshold = std::atan(0.3);
  EXPECT_LT(std::abs(slide(0.8 * threshold, 0.3, g, time)), 0.01 * g * time);
  EXPECT_GT(slide(1.3 * threshold, 0.3, g, time), 0.05 * g * time);
}

/// Nodes of a block indented by a corner tool with friction, the whole scene turned by `angle`, turned back.
std::vector<Vec2> indent(double angle) {
  const Mat2 R = rotation(angle);
  Cloud<2> cloud = rectangle(4e-3, 2e-3, 2e-4, Lattice::hexagonal, 0.15);
  std::vector<Support<2>> base{
      {"base n", Support<2>::Kind::velocity, R * Vec2(0, 1), TimeTable(0.0), nodes_on(cloud, 0_piece)},
      {"base t", Support<2>::Kind::velocity, R * Vec2(1, 0), TimeTable(0.0), nodes_on(cloud, 0_piece)}};
  for (Vec2& x : cloud.position) x = R * x;
  Problem<2> model = model_of(std::move(cloud), Method::cnem, steel_304L());
  model.supports = Supports<2>(std::move(base), static_cast<std::size_t>(model.cloud.nodes()));
  std::vector<Vec2> corners{{1.13e-3, 2.0e-3}, {3.2e-3, 2.3e-3}, {3.2e-3, 4e-3}, {1.13e-3, 4e-3}};
  for (Vec2& x : corners) x = R * x;
  model.contact = contact::RigidContact<2>({polygon_tool(corners, R * Vec2(15.0, -30.0), 0.2)});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = 1.2e-8;
  for (int n = 0; n < 600; ++n) solver.advance(dt);
  EXPECT_GT(solver.ledger()["friction"], 0.0);
  EXPECT_GT(solver.ledger()["plastic"], 0.0);
  std::vector<Vec2> nodes;
  for (std::size_t i = 0; i < solver.state().node.size(); ++i)
    nodes.push_back(R.transpose() *
                    Vec2(solver.state().node.position[0][i], solver.state().node.position[1][i]));
  return nodes;
}

TEST(RotatedTool, gives_rotated_results) {
  const std::vector<Vec2> straight = indent(0.0);
  for (const double angle : {0.65, 2.2, -1.1}) {
    const std::vector<Vec2> turned = indent(angle);
    double worst = 0.0;
    for (std::size_t i = 0; i < straight.size(); ++i)
      worst = std::max(worst, (turned[i] - straight[i]).norm());
    EXPECT_LT(worst, 1e-9) << "angle " << angle; // 2e-4 spacing: 5e-6 of it
  }
}

TEST(Corner, between_two_nodes_does_not_pass_through) {
  Cloud<2> cloud = rectangle(4e-3, 2e-3, 4e-4, Lattice::square, 0.0);
  Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
  std::vector<Support<2>> base{
      {"base", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(cloud, 0_piece)}};
  model.supports = Supports<2>(std::move(base), static_cast<std::size_t>(cloud.nodes()));
  // A wedge whose only corner comes down in the middle between two nodes.
  model.contact = contact::RigidContact<2>(
      {polygon_tool({{1.8e-3, 2.0e-3}, {2.6e-3, 4.0e-3}, {1.0e-3, 4.0e-3}}, {0, -20.0}, 0.0)});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  for (int n = 0; n < 800; ++n) {
    if (n % 50 == 49) solver.prepare();
    solver.advance(1.5e-8);
  }
  const double tip = 2.0e-3 - 20.0 * solver.state().time;
  const NodeState<2>& node = solver.state().node;
  for (const Facet<2>& facet : solver.conditions().cloud.facets) {
    const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
    if (facet.piece != 2_piece || (node.position[0][a] - 1.8e-3) * (node.position[0][b] - 1.8e-3) > 0.0)
      continue;
    const double s = (1.8e-3 - node.position[0][a]) / (node.position[0][b] - node.position[0][a]);
    EXPECT_LT((1.0 - s) * node.position[1][a] + s * node.position[1][b], tip + 1e-7);
  }
  EXPECT_GT(-solver.conditions().contact.results()[0].force.y(), 0.0);
}

} // namespace
} // namespace cnem::testing
