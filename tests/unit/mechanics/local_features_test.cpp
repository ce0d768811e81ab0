// Local time steps with what else acts in a step: the same laws of conservation, the same results as with
// the global step.
#include "tests/unit/mechanics/graded.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <omp.h>

namespace cnem::testing {
namespace {

/// Of two runs to the same time: of the punch, N s/m, and of the ledger, J/m.
struct Shearing {
  double impulse, plastic, friction, external, residual;
  int sub_steps;
};

Shearing shear(Problem<2> model, double end, int rereference_every = 0) {
  ExplicitSolver<2> solver = at_rest(std::move(model));
  advance(solver, end, rereference_every);
  const EnergyLedger ledger = solver.ledger();
  return {-solver.conditions().contact.results()[0].impulse.y(),
          ledger["plastic"],
          ledger["friction"],
          ledger.external(),
          ledger.residual(),
          solver.sub_steps()};
}

void expect_alike(const Shearing& local, const Shearing& global, double tolerance) {
  EXPECT_NEAR(local.impulse, global.impulse, tolerance * global.impulse);
  EXPECT_NEAR(local.plastic, global.plastic, tolerance * global.plastic);
  EXPECT_NEAR(local.external, global.external, tolerance * global.external);
  EXPECT_LT(std::abs(local.residual), 1e-3 * local.external);
}

TEST(LocalMassScaling, follows_the_global_step) {
  for (const MassScaling scaling : {MassScaling{.factor = 4.0}, MassScaling{.step = 4e-9}}) {
    const auto scaled = [&](bool local) {
      Problem<2> model = graded_shearing(40.0, 1.6e-4);
      model.mass_scaling = scaling;
      model.safety = 0.5;
      model.local = {.on = local, .least_gain = 0.0};
      return shear(std::move(model), 6e-7, local ? 20 : 160);
    };
    const Shearing local = scaled(true);
    EXPECT_EQ(local.sub_steps, scaling.step > 0.0 ? 2 : 8) << "less is left to levels where a step is wanted";
    expect_alike(local, scaled(false), 5e-3);
  }
}

TEST(LocalMassScaling, keeps_the_momenta_of_its_inertia) {
  const double omega = 2e4;
  const Vec2 centre(5e-3, 5e-3);
  Problem<2> model = graded_square();
  model.mass_scaling.step = 8e-9;
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return Vec2(30, -10) + omega * left_normal(x - centre);
  });
  const double dt = solver.stable_step().dt;
  solver.advance(dt);
  ASSERT_EQ(solver.sub_steps(), 4);
  const auto now = [&] {
    const NodeState<2>& node = solver.state().node;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < node.size(); ++i) {
      const Vec2 x(node.position[0][i], node.position[1][i]);
      const Vec2 p = node.inertia()[i] * Vec2(node.velocity[0][i], node.velocity[1][i]);
      sum += Eigen::Vector3d(p.x(), p.y(), cross(x, p));
    }
    return sum;
  };
  const Eigen::Vector3d before = now();
  for (int n = 0; n < 1000; ++n) solver.advance(dt);
  const double scale = 7850.0 * 1e-4 * omega * centre.x();
  EXPECT_LT((now() - before).head<2>().norm(), 1e-13 * scale);
  EXPECT_NEAR(now().z(), before.z(), 1e-13 * scale * 1e-2);
}

/// The metal breaks at the corners of the tools, on references that are renewed.
TEST(LocalDamage, breaks_as_with_the_global_step) {
  const auto broken = [](bool local) {
    Problem<2> model = graded_shearing(60.0, 2e-4);
    model.materials.front().damage =
        plasticity::Damage{{.fracture_energy = 5e3, .residual_strength = 0.2},
                           plasticity::JohnsonCookDamage{.D1 = 0.05, .D2 = 0.05, .D3 = -1.5}};
    model.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 4e-6, local ? 20 : 160);
    EXPECT_EQ(solver.sub_steps() > 1, local);
    return solver;
  };
  const ExplicitSolver<2> global = broken(false), local = broken(true);
  const auto softened = [](const ExplicitSolver<2>& solver) {
    const PointState<2>& point = solver.state().point;
    double sum = 0.0;
    for (std::size_t p = 0; p < point.size(); ++p)
      sum += solver.approximation().mechanics.volume[p] * point.softening[p];
    return sum;
  };
  EXPECT_EQ(std::ranges::max(global.state().point.softening), 1.0);
  EXPECT_EQ(std::ranges::max(local.state().point.softening), 1.0);
  EXPECT_NEAR(softened(local), softened(global), 0.05 * softened(global));
  const EnergyLedger a = global.ledger(), b = local.ledger();
  EXPECT_NEAR(b["plastic"], a["plastic"], 5e-3 * a["plastic"]);
  EXPECT_NEAR(b.external(), a.external(), 5e-3 * a.external());
  EXPECT_LT(std::abs(b.residual()), 2e-3 * b.external());
}

/// A square whose middle is fine, wrung so that it flows.
ExplicitSolver<2> wrung(double exchange, bool local, double end) {
  Problem<2> model = model_of(graded_rectangle(2e-3, 2e-3, 1.2e-4, 2e-5, {{0.9e-3, 1e-3}, {1.1e-3, 1e-3}}),
                              Method::cnem, steel_304L());
  model.pressure_exchange = exchange;
  model.viscosity = {1.2, 0.06};
  model.local = {.on = local, .least_gain = 0.0};
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2& x) -> Vec2 {
    return {60.0 * std::sin(2000.0 * x.y()), -80.0 * std::sin(1500.0 * x.x())};
  });
  advance(solver, end, local ? 40 : 160);
  return solver;
}

TEST(LocalPressureExchange, keeps_volume_momentum_and_the_energy_balance) {
  const double end = 3e-6;
  ExplicitSolver<2> local = wrung(0.3, true, end);
  ASSERT_GE(local.sub_steps(), 2);
  const Momenta before = momenta(local);
  const DiscreteOperators<2>& operators = local.approximation().mechanics;
  local.prepare();
  const Field start = local.state().point.stress_free;
  const auto traded = [&] { // δ ln of stress-free volumes is −δθ
    double sum = 0.0, size = 0.0;
    for (std::size_t p = 0; p < start.size(); ++p) {
      const double theta = -std::log(local.state().point.stress_free[p] / start[p]);
      sum += operators.volume[p] * theta;
      size += operators.volume[p] * std::abs(theta);
    }
    return std::pair(sum, size);
  };
  const double dt = local.stable_step().dt;
  for (int n = 0; n < 20; ++n) local.advance(dt);
  const auto [sum, size] = traded();
  EXPECT_GT(size, 0.0);
  EXPECT_LT(std::abs(sum), 1e-9 * size);
  const Momenta after = momenta(local);
  const double scale = 4e-6 * 7850.0 * 80.0;
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * scale);
  EXPECT_LT(std::abs(after.angular - before.angular), 1e-12 * scale * 1e-3);
  EXPECT_LT(std::abs(local.ledger().residual()), 2e-3 * local.ledger().initial());
}

TEST(LocalPressureExchange, smooths_as_with_the_global_step) {
  const auto sheared = [](double exchange, bool local) {
    Problem<2> model = graded_shearing(60.0, 2e-4);
    model.pressure_exchange = exchange;
    model.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 2e-6);
    EXPECT_EQ(solver.sub_steps(), local ? 8 : 1);
    return solver;
  };
  const ExplicitSolver<2> plain = sheared(0.0, true), local = sheared(0.3, true),
                          global = sheared(0.3, false);
  const EnergyLedger a = global.ledger(), b = local.ledger();
  EXPECT_NEAR(b["plastic"], a["plastic"], 3e-3 * a["plastic"]);
  EXPECT_NEAR(b["pressure_exchange"], a["pressure_exchange"], 0.05 * a["pressure_exchange"]);
  const double noise = metric_of(global, "pressure_noise");
  EXPECT_NEAR(metric_of(local, "pressure_noise"), noise, 0.1 * noise);
  EXPECT_LT(noise, 0.8 * metric_of(plain, "pressure_noise"));
}

/// Triangles: points are not nodes.
TEST(LocalTriangles, follow_the_global_step) {
  const auto sheared = [](bool local) {
    Problem<2> model = graded_shearing(40.0, 1.6e-4);
    model.method = make(Method::triangles);
    model.local.on = local;
    return shear(std::move(model), 1e-6);
  };
  const Shearing local = sheared(true);
  EXPECT_GE(local.sub_steps, 4);
  expect_alike(local, sheared(false), 3e-3);
}

TEST(LocalTriangles, make_as_much_heat_and_keep_it) {
  const auto sheared = [](bool local) {
    Problem<2> model = graded_shearing(40.0, 1.6e-4);
    model.method = make(Method::triangles);
    model.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 1e-6);
    return solver;
  };
  const ExplicitSolver<2> global = sheared(false), local = sheared(true);
  const EnergyLedger a = global.ledger(), b = local.ledger();
  EXPECT_NEAR(b["heat_generated"], a["heat_generated"], 3e-3 * a["heat_generated"]);
  EXPECT_LT(std::abs(b.heat_residual()), 1e-9 * b["heat_generated"]);
}

TEST(LocalTriangles, keep_the_momenta) {
  const double omega = 2e4;
  const Vec2 centre(5e-3, 5e-3);
  Problem<2> model = graded_square();
  model.method = make(Method::triangles);
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return Vec2(30, -10) + omega * left_normal(x - centre);
  });
  const double dt = solver.stable_step().dt;
  solver.advance(dt);
  ASSERT_GE(solver.sub_steps(), 4);
  const Momenta before = momenta(solver);
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    solver.advance(dt);
    worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  const Momenta after = momenta(solver);
  const double scale = 7850.0 * 1e-4 * omega * centre.x();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13 * scale);
  EXPECT_NEAR(after.angular, before.angular, 1e-13 * scale * 1e-2);
  EXPECT_LT(worst, 1e-4 * solver.ledger().initial());
}

TEST(LocalTriangles, all_of_them_at_one_level_give_the_bits_of_the_global_step) {
  std::vector<Field> seen;
  for (const bool local : {false, true}) {
    Problem<2> model = graded_shearing(40.0, 1.6e-4);
    model.method = make(Method::triangles);
    model.local = {.on = local, .levels = 1, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 3e-7);
    seen.push_back(all_of(solver));
  }
  EXPECT_EQ(seen[0], seen[1]);
}

TEST(LocalFeatures, same_bits_for_any_number_of_threads) {
  for (const Method method : {Method::cnem, Method::triangles}) {
    std::vector<Field> seen;
    for (const int threads : {1, 3}) {
      omp_set_num_threads(threads);
      Problem<2> model = graded_shearing(60.0, 1.6e-4);
      model.method = make(method);
      if (method == Method::cnem) model.pressure_exchange = 0.3;
      if (method == Method::triangles)
        model.materials.front().damage =
            plasticity::Damage{{.fracture_energy = 5e3}, plasticity::JohnsonCookDamage{.D1 = 0.001}};
      model.mass_scaling.factor = 2.0;
      model.local = {.on = true, .least_gain = 0.0};
      ExplicitSolver<2> solver = at_rest(std::move(model));
      advance(solver, 3e-7);
      EXPECT_GE(solver.sub_steps(), 4);
      seen.push_back(all_of(solver));
      seen.back().push_back(solver.ledger().total());
    }
    EXPECT_EQ(seen[0], seen[1]);
  }
  omp_set_num_threads(2);
}

} // namespace
} // namespace cnem::testing
