// Applied forces, prescribed motion, bulk viscosity and the penalty of the stabilisation, each against what
// it must do.
#include "tests/unit/mechanics/linear.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

Vec2 mean_velocity(const ExplicitSolver<2>& solver) {
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  return momenta(solver).linear / mass;
}

TEST(Loads, body_force_makes_a_free_body_fall_exactly_and_books_the_work) {
  Problem<2> model = model_of(rectangle(2e-3, 1e-3, 2.5e-4), Method::cnem, steel());
  const Vec2 g(3e3, -9e3);
  model.loads = Loads<2>({}, {}, {TimeTable(g.x()), TimeTable(g.y())}, model.cloud.position);
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt;
  for (int n = 0; n < 300; ++n) solver.advance(dt);
  // v_{n−½} = g (t_n − Δt/2) exactly, the first step being a half one.
  EXPECT_LT((mean_velocity(solver) - g * (solver.state().time - 0.5 * dt)).norm(),
            1e-12 * g.norm() * solver.state().time);
  const EnergyLedger e = solver.ledger();
  EXPECT_NEAR(e["load_work"], e["kinetic"], 1e-9 * e["load_work"]);
}

TEST(Loads, traction_accelerates_by_force_over_mass) {
  Cloud<2> cloud = rectangle(2e-3, 1e-3, 2.5e-4);
  std::vector<Facet<2>> right;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == 1_piece) right.push_back(facet);
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.loads = Loads<2>({{"pull", {TimeTable(2e6), TimeTable(-1e6)}, right}}, {}, {}, cloud.position);
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  const double dt = solver.stable_step().dt;
  for (int n = 0; n < 200; ++n) solver.advance(dt);
  const Vec2 impulse = Vec2(2e6, -1e6) * 1e-3 * (solver.state().time - 0.5 * dt);
  EXPECT_LT((momenta(solver).linear - impulse).norm(), 1e-11 * impulse.norm());
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger()["load_work"]);
}

TEST(Loads, pressure_on_a_closed_boundary_pushes_nowhere_and_follows_it) {
  Cloud<2> cloud = rectangle(2e-3, 1e-3, 2.5e-4);
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.loads = Loads<2>({}, {{"all round", TimeTable(1e8), cloud.facets}}, {}, cloud.position);
  model.viscosity = {1.2, 0.5};
  ExplicitSolver<2> solver =
      start(std::move(model), [](const Vec2& x) -> Vec2 { return 2e4 * left_normal(x - Vec2(1e-3, 5e-4)); });
  const Momenta before = momenta(solver);
  double dt = 0.0;
  for (int n = 0; n < 1500; ++n) {
    if (n % 10 == 0) dt = solver.stable_step().dt;
    solver.advance(dt);
  }
  EXPECT_LT((momenta(solver).linear - before.linear).norm(), 1e-9 * 7850 * 2e-6);
  double pressure = 0.0;
  for (const double p : solver.state().point.pressure)
    pressure += p / static_cast<double>(solver.state().point.size());
  // −tr σ/3 of σ_xx = σ_yy = −p in plane strain: p 2(1 + ν)/3.
  EXPECT_NEAR(pressure, 1e8 * 2.0 * 1.33 / 3.0, 0.03e8);
}

TEST(Supports, ramps_and_displacement_tables_are_followed_exactly) {
  Cloud<2> cloud = rectangle(2e-3, 1e-3, 2.5e-4);
  const TimeTable ramp({0.0, 1e-6}, {0.0, 20.0}), path({0.0, 2e-6, 4e-6}, {0.0, 3e-5, 1e-5});
  std::vector<Support<2>> supports{
      {"pull", Support<2>::Kind::velocity, Vec2(1, 0), ramp, nodes_on(cloud, 1_piece)},
      {"lift", Support<2>::Kind::displacement, Vec2(0, 1), path, nodes_on(cloud, 0_piece)},
      {"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece)}};
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.supports = Supports<2>(supports, static_cast<std::size_t>(cloud.nodes()));
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  while (solver.state().time < 3e-6) solver.advance(1.3e-8);
  const double t = solver.state().time;
  const auto moved = [&](NodeIndex i, std::size_t k) {
    const auto n = static_cast<std::size_t>(i);
    return solver.state().node.position[k][n] - solver.state().node.initial_position[k][n];
  };
  for (const NodeIndex i : nodes_on(cloud, 1_piece)) EXPECT_NEAR(moved(i, 0), ramp.integral(t), 1e-15);
  for (const NodeIndex i : nodes_on(cloud, 0_piece)) EXPECT_NEAR(moved(i, 1), path(t), 1e-15);
  for (const NodeIndex i : nodes_on(cloud, 3_piece)) EXPECT_EQ(moved(i, 0), 0.0);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * std::abs(solver.ledger()["support_work"]));
}

TEST(Supports, oblique_moving_supports_are_refused) {
  using Kind = Support<2>::Kind;
  EXPECT_THROW(Supports<2>({{"a", Kind::velocity, Vec2(1, 0), TimeTable(1.0), {0_node}},
                            {"b", Kind::symmetry, Vec2(1, 1).normalized(), {}, {0_node}}},
                           1),
               InputError);
  const Supports<2> two_planes({{"a", Kind::symmetry, Vec2(1, 0), {}, {0_node}},
                                {"b", Kind::symmetry, Vec2(1, 1).normalized(), {}, {0_node}}},
                               1);
  ASSERT_EQ(two_planes.constraints().size(), 1U);
  EXPECT_LT(two_planes.constraints()[0].free.norm(), 1e-12) << "two planes hold a corner altogether";
}

TEST(BulkViscosity, calms_a_shock_books_its_heat_and_shortens_the_step) {
  const auto shock = [](BulkViscosity viscosity, double& overshoot, double& step) {
    Cloud<2> cloud = rectangle(2e-2, 1e-3, 2e-4, Lattice::square, 0.0);
    std::vector<Support<2>> wall{
        {"wall", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece)}};
    std::vector<NodeIndex> all(static_cast<std::size_t>(cloud.nodes()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = as<NodeIndex>(i);
    wall.push_back({"guide", Support<2>::Kind::symmetry, Vec2(0, 1), {}, all});
    Problem<2> model = model_of(cloud, Method::cnem, steel());
    model.supports = Supports<2>(std::move(wall), all.size());
    model.viscosity = viscosity;
    const plasticity::Material material = model.materials.front();
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {-5.0, 0}; });
    solver.advance(solver.stable_step().dt);
    step = solver.stable_step().dt;
    while (solver.state().time < 2e-6) solver.advance(0.9 * step);
    const double exact = material.density * material.elasticity.dilatational_speed(material.density) * 5.0;
    overshoot = 0.0;
    for (std::size_t p = 0; p < solver.state().point.size(); ++p)
      overshoot = std::max(overshoot, -solver.state().point.piola[0][p] / exact - 1.0);
    EXPECT_LT(std::abs(solver.ledger().residual()), 2e-3 * solver.ledger().initial());
    return solver.ledger()["viscosity"];
  };
  double bare = 0.0, calm = 0.0, bare_step = 0.0, calm_step = 0.0;
  EXPECT_EQ(shock({}, bare, bare_step), 0.0);
  EXPECT_GT(shock({1.2, 0.3}, calm, calm_step), 0.0);
  EXPECT_LT(calm, 0.6 * bare);
  EXPECT_LT(calm_step, bare_step);
}

TEST(EdgeDefect, force_is_minus_the_slope_of_its_energy_and_blind_to_rotation) {
  const Cloud<2> cloud = rectangle(2e-3, 2e-3, 4e-4, Lattice::hexagonal, 0.2);
  Approximation<2> approximation = make(Method::cnem)->rebuild(cloud);
  const DiscreteOperators<2>& op = approximation.mechanics;
  const auto n = static_cast<std::size_t>(op.nodes);
  EdgeDefect<2> edges(0.05);
  edges.reset(Field(n, 80e9));
  Fields<2> X, x, force;
  resize_all(X, n);
  Random random(5);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) X[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
  Fields<5> F, P;
  resize_all(F, n);
  const auto energy = [&] {
    resize_all(P, n);
    resize_all(force, n);
    const Field side = side_by_side<2>(x);
    deformation_gradient<2>(op, side, F, 0, n);
    edges.store_records(F, side_by_side<2>(X), 0, n);
    ColumnStress<2> stress;
    copy_stress_columns<2>(P, stress);
    const double stored = edges.apply(approximation.links, op.volume, side, stress, force, 0, n).stored;
    subtract_internal_force<2>(op, stress, force, 0, n);
    return stored;
  };
  x = X;
  for (std::size_t i = 0; i < n; ++i) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    x[0][i] = c * X[0][i] - s * X[1][i] + 0.3;
    x[1][i] = s * X[0][i] + c * X[1][i] - 0.1;
  }
  const double turned = energy();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) x[k][i] = X[k][i] + 2e-5 * random.uniform(-1, 1);
  const double scale = energy();
  EXPECT_GT(scale, 0.0);
  EXPECT_LT(turned, 1e-18 * scale * 1e6);
  const Fields<2> slope = force;
  Vec2 sum = Vec2::Zero();
  double moment = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += Vec2(slope[0][i], slope[1][i]);
    moment += x[0][i] * slope[1][i] - x[1][i] * slope[0][i];
  }
  EXPECT_LT(sum.norm(), 1e-10 * scale / 1e-5);
  EXPECT_LT(std::abs(moment), 1e-9 * scale);
  for (std::size_t i = 0; i < n; i += 3)
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = 1e-8, at = x[k][i];
      x[k][i] = at + h;
      const double above = energy();
      x[k][i] = at - h;
      const double below = energy();
      x[k][i] = at;
      EXPECT_NEAR(slope[k][i], -(above - below) / (2 * h), 1e-6 * scale / 1e-5);
    }
}

} // namespace
} // namespace cnem::testing
