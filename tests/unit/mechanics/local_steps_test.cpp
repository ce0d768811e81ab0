// Local time steps: what they keep exactly, and the global step they are held against.
#include "tests/unit/mechanics/graded.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <omp.h>

namespace cnem::testing {
namespace {

TEST(LocalSteps, levels_keep_to_stable_steps_and_to_their_neighbours) {
  ExplicitSolver<2> solver = at_rest(graded_square());
  const double macro = solver.stable_step().dt / solver.model().safety;
  solver.advance(macro);
  const LocalSteps<2>& local = solver.local_steps();
  const DiscreteOperators<2>& op = solver.approximation().mechanics;
  ASSERT_EQ(local.highest(), 3);
  EXPECT_LT(local.updates(), 0.5 * 8.0 * op.nodes);
  const auto& elastic = solver.model().materials.front().elasticity;
  SpectralBound<2> bound;
  const auto each = bound.of_ranges(op, solver.state().point.deformation,
                                    Field(solver.state().point.size(), elastic.lambda() + 2.0 * elastic.mu()),
                                    solver.state().node.mass, LocalSteps<2>::block);
  const double finest = macro / local.sub_steps();
  for (std::size_t b = 0; b < each.size(); ++b)
    EXPECT_LE(finest * (1 << local.level()[b]),
              stable_wave_step(each[b].value, solver.model().stabilisation, 0.0) * (1.0 + 1e-12));
  const auto level_of = [&](PointIndex i) {
    return local.level()[static_cast<std::size_t>(i) / LocalSteps<2>::block];
  };
  for (int j = 0; j < op.nodes; ++j) {
    int least = 9, most = 0;
    for (auto e = static_cast<std::size_t>(op.col_begin[static_cast<std::size_t>(j)]);
         e < static_cast<std::size_t>(op.col_begin[static_cast<std::size_t>(j) + 1]); ++e) {
      least = std::min<int>(least, level_of(op.point[e]));
      most = std::max<int>(most, level_of(op.point[e]));
    }
    EXPECT_LE(most - least, 1) << "node " << j;
    EXPECT_LE(local.weight(static_cast<std::size_t>(j)), 1 << least) << "node " << j;
  }
  // Each point is due as often as its level asks for.
  std::vector<int> due(local.level().size(), 0);
  for (int s = 1; s <= local.sub_steps(); ++s)
    for (const LevelRange& range : local.points(local.activity(s)))
      for (std::size_t b = range.begin / LocalSteps<2>::block; b * LocalSteps<2>::block < range.end; ++b)
        ++due[b];
  for (std::size_t b = 0; b < due.size(); ++b) EXPECT_EQ(due[b], local.sub_steps() >> local.level()[b]);
}

TEST(LocalSteps, where_they_save_little_all_take_the_finest_step) {
  Problem<2> model = model_of(rectangle(4e-3, 4e-3, 4e-4), Method::cnem, steel());
  model.local.on = true;
  ExplicitSolver<2> solver = at_rest(std::move(model));
  const double dt = solver.stable_step().dt;
  EXPECT_EQ(solver.sub_steps(), 1);
  EXPECT_EQ(dt, at_rest(model_of(rectangle(4e-3, 4e-3, 4e-4), Method::cnem, steel())).stable_step().dt);
}

TEST(LocalSteps, one_level_gives_the_bits_of_the_global_step) {
  Problem<2> global = graded_shearing(40.0), local = graded_shearing(40.0);
  local.local = {.on = true, .levels = 1, .least_gain = 0.0};
  ExplicitSolver<2> a = at_rest(std::move(global)), b = at_rest(std::move(local));
  advance(a, 5e-7, 30);
  advance(b, 5e-7, 30);
  EXPECT_EQ(a.state().step, b.state().step);
  EXPECT_EQ(all_of(a), all_of(b));
  EXPECT_EQ(a.ledger().total(), b.ledger().total());
  EXPECT_EQ(a.ledger().external(), b.ledger().external());
  EXPECT_EQ(a.conditions().contact.results()[0].force, b.conditions().contact.results()[0].force);
}

TEST(LocalSteps, momenta_are_exact) {
  const double omega = 2e4; // rad/s: 140 m/s at the corners, half a turn
  const Vec2 drift(30.0, -10.0), centre(5e-3, 5e-3);
  ExplicitSolver<2> solver =
      start(graded_square(), [&](const Vec2& x) -> Vec2 { return drift + omega * left_normal(x - centre); });
  const double dt = solver.stable_step().dt;
  solver.advance(dt);
  ASSERT_EQ(solver.sub_steps(), 8);
  const Momenta before = momenta(solver);
  const double energy = solver.ledger().initial();
  double worst = 0.0, mass = 0.0;
  while (solver.state().time < std::numbers::pi / omega) {
    solver.advance(dt);
    worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  const Momenta after = momenta(solver);
  for (const double m : solver.state().node.mass) mass += m;
  const double scale = mass * omega * centre.x();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13 * scale);
  EXPECT_NEAR(after.angular, before.angular, 1e-13 * scale * 1e-2);
  EXPECT_LT(worst, 1e-4 * energy);
}

/// A body that falls freely stays without stress, to rounding, whatever the levels: before they are chosen,
/// as they change, on new references, and with steps of another length.
TEST(LocalSteps, free_fall_makes_no_stress) {
  Problem<2> model = graded_square();
  const Vec2 g(3e6, -1e7);
  model.loads = Loads<2>({}, {}, {TimeTable(g.x()), TimeTable(g.y())}, model.cloud.position);
  const double young = 210e9;
  ExplicitSolver<2> solver = at_rest(std::move(model));
  const double macro = solver.stable_step().dt, finest = macro / solver.sub_steps();
  solver.prepare(); // forgets what was chosen
  ASSERT_EQ(solver.sub_steps(), 1);
  for (int n = 0; n < 5; ++n) solver.advance(finest);
  ASSERT_NEAR(solver.stable_step().dt, macro, 1e-9 * macro);
  for (int n = 0; n < 20; ++n) {
    solver.advance(n % 3 == 0 ? 0.7 * macro : macro);
    if (n == 10) solver.prepare();
  }
  ASSERT_EQ(solver.sub_steps(), 8);
  const double t = solver.state().time;
  for (std::size_t i = 0; i < solver.state().node.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(solver.state().node.position[k][i] - solver.state().node.initial_position[k][i],
                  0.5 * g[static_cast<Eigen::Index>(k)] * t * t, 1e-15);
  for (const Field& component : solver.state().point.piola)
    for (const double stress : component) ASSERT_LT(std::abs(stress), 1e-9 * young);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-9 * solver.ledger()["load_work"]);
}

/// Every node with a random velocity, all frequencies there are: 10⁵ finest steps.
TEST(LocalSteps, energy_stays_bounded) {
  Random random(3);
  ExplicitSolver<2> solver = start(graded_square(), [&](const Vec2&) -> Vec2 {
    return {random.uniform(-1, 1), random.uniform(-1, 1)};
  });
  const double dt = solver.stable_step().dt;
  double worst[2] = {0.0, 0.0};
  const int count = 40000 / solver.sub_steps();
  for (int n = 0; n < count; ++n) {
    solver.advance(dt);
    if (n % 5 != 0) continue;
    const EnergyLedger ledger = solver.ledger();
    double& most = worst[n < count / 2 ? 0 : 1];
    most = std::max(most, std::abs(ledger.residual()) / ledger.initial());
  }
  EXPECT_EQ(solver.sub_steps(), 8);
  EXPECT_LT(worst[0], 0.01);
  EXPECT_LT(worst[1], 1.5 * worst[0]) << "it grows";
}

double pulse(double s) { return std::exp(-s * s); }

struct PulseError {
  double velocity, displacement; ///< relative L2 errors at t_n
  double residual;               ///< over the energy
  int sub_steps;
};

/// A pulse starts in the coarse part of a bar, splits and crosses the fine middle; lateral motion held.
PulseError pulse_error(double h, bool local) {
  const double length = 4e-2, width = 3e-3, centre = 1e-2, half_width = 3e-3, v0 = 1.0;
  const Cloud<2> cloud = graded_rectangle(length, width, h, h / 4.0, {{1.8e-2, 1.5e-3}, {2.2e-2, 1.5e-3}});
  std::vector<NodeIndex> all(static_cast<std::size_t>(cloud.nodes()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = as<NodeIndex>(i);
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.supports = Supports<2>({{"lateral", Support<2>::Kind::symmetry, Vec2(0, 1), {}, all}}, all.size());
  model.local = {.on = local, .least_gain = 0.0};
  const plasticity::Material material = model.materials.front();
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {v0 * pulse((x.x() - centre) / half_width), 0.0};
  });
  const double c = material.elasticity.dilatational_speed(material.density), end = 0.5 * length / c;
  advance(solver, end);
  const State<2>& state = solver.state();
  const double half = 0.5 * state.step_before / solver.sub_steps();
  double errors[2] = {0.0, 0.0}, norms[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    const double X = solver.state().node.initial_position[0][i];
    double v = 0.0, u = 0.0; // both waves, and what the free ends reflect
    for (const double image : {centre, -centre, 2.0 * length - centre})
      for (const double sign : {-1.0, 1.0}) {
        const double s = (X + sign * c * end - image) / half_width;
        v += 0.5 * v0 * pulse(s);
        u += 0.25 * v0 / c * half_width / std::numbers::inv_sqrtpi * sign * std::erf(s);
      }
    const double m = state.node.mass[i];
    const double dv = state.node.velocity[0][i] + half * state.node.force[0][i] / m - v;
    const double du = state.node.position[0][i] - X - u;
    errors[0] += m * dv * dv;
    norms[0] += m * v * v;
    errors[1] += m * du * du;
    norms[1] += m * u * u;
  }
  const EnergyLedger ledger = solver.ledger();
  return {std::sqrt(errors[0] / norms[0]), std::sqrt(errors[1] / norms[1]),
          std::abs(ledger.residual()) / ledger.initial(), solver.sub_steps()};
}

TEST(LocalSteps, pulse_crosses_levels_as_with_the_global_step) {
  PulseError last{};
  for (const double h : {0.4e-3, 0.2e-3, 0.1e-3}) {
    const PulseError local = pulse_error(h, true), global = pulse_error(h, false);
    EXPECT_LT(local.velocity, 1.02 * global.velocity) << h;
    EXPECT_LT(local.displacement, 1.02 * global.displacement) << h;
    EXPECT_LT(local.residual, 1e-6) << h;
    EXPECT_GE(local.sub_steps, 2);
    if (last.velocity > 0.0) {
      EXPECT_GT(std::log2(last.velocity / local.velocity), 1.7) << h;
      EXPECT_GT(std::log2(last.displacement / local.displacement), 1.7) << h;
    }
    last = local;
  }
}

TimeTable ramp(double value) { return {std::vector<double>{0.0, 1e-6}, std::vector<double>{0.0, value}}; }

/// Body force, traction, pressure, moving and resting supports, ties: what acts on nodes from outside. What
/// is left between the two falls with the square of the step.
TEST(LocalSteps, loads_supports_and_ties_act_as_with_the_global_step) {
  const auto loaded = [](bool local, double safety) {
    Cloud<2> cloud = graded_rectangle(4e-3, 4e-3, 2e-4, 2.5e-5, {{2e-3, 3.8e-3}, {2e-3, 4e-3}});
    const auto n = static_cast<std::size_t>(cloud.nodes());
    std::vector<Facet<2>> right, top;
    for (const Facet<2>& facet : cloud.facets) {
      if (facet.piece == 1_piece) right.push_back(facet);
      if (facet.piece == 2_piece) top.push_back(facet);
    }
    Problem<2> model = model_of(cloud, Method::cnem, steel());
    model.supports =
        Supports<2>({{"base", Support<2>::Kind::velocity, Vec2(0, 1), ramp(2.0), nodes_on(cloud, 0_piece)},
                     {"side", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece)}},
                    n);
    model.loads = Loads<2>({{"pull", {ramp(4e7), TimeTable(0.0)}, right}}, {{"press", ramp(3e7), top}},
                           {TimeTable(0.0), ramp(-5e6)}, cloud.position);
    const auto sides = nodes_on(cloud, 1_piece);
    model.ties = Ties<2>({{sides[2], sides[5]}}, cloud.position);
    model.safety = safety;
    model.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 2e-6);
    return solver;
  };
  const ExplicitSolver<2> global = loaded(false, 0.45);
  const EnergyLedger a = global.ledger();
  double energy[2], apart[2];
  int k = 0;
  for (const double safety : {0.9, 0.45}) {
    const ExplicitSolver<2> local = loaded(true, safety);
    EXPECT_GE(local.sub_steps(), 4);
    const EnergyLedger b = local.ledger();
    EXPECT_NEAR(b["load_work"], a["load_work"], 3e-3 * a.external());
    EXPECT_NEAR(b["support_work"], a["support_work"], 6e-3 * a["support_work"]);
    EXPECT_LT(std::abs(b.residual()), 2e-3 * b.external());
    energy[k] = std::abs(b["elastic"] / a["elastic"] - 1.0);
    double difference = 0.0, displacement = 0.0;
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < local.state().node.size(); ++i) {
        const double u = global.state().node.position[c][i] - global.state().node.initial_position[c][i];
        const double w = local.state().node.position[c][i] - local.state().node.initial_position[c][i];
        difference = std::max(difference, std::abs(u - w));
        displacement = std::max(displacement, std::abs(u));
      }
    apart[k++] = difference / displacement;
  }
  EXPECT_LT(energy[0], 5e-3);
  EXPECT_LT(energy[1], energy[0] / 3.5);
  EXPECT_LT(apart[0], 0.02);
  EXPECT_LT(apart[1], apart[0] / 3.0);
}

/// A round bar on a wall.
TEST(LocalSteps, bodies_of_revolution_follow_the_global_step) {
  const auto struck = [](bool local) {
    Cloud<2> cloud = graded_rectangle(2e-3, 4e-3, 2e-4, 2.5e-5, {{1.8e-3, 0}, {2e-3, 0}});
    Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
    model.method = make(Method::cnem, Space::revolution);
    model.supports =
        Supports<2>({{"wall", Support<2>::Kind::symmetry, Vec2(0, -1), {}, nodes_on(cloud, 0_piece)},
                     {"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece)}},
                    static_cast<std::size_t>(cloud.nodes()));
    model.stabilisation = 0.2;
    model.viscosity = {1.2, 0.06};
    model.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0.0, -100.0}; });
    advance(solver, 1.5e-6, local ? 25 : 200);
    return solver;
  };
  const ExplicitSolver<2> global = struck(false), local = struck(true);
  EXPECT_GE(local.sub_steps(), 4);
  const EnergyLedger a = global.ledger(), b = local.ledger();
  EXPECT_NEAR(b["plastic"], a["plastic"], 5e-3 * a["plastic"]);
  EXPECT_NEAR(b["kinetic"], a["kinetic"], 5e-3 * a["kinetic"]);
  EXPECT_LT(std::abs(b.residual()), 1e-3 * b.initial());
}

TEST(LocalSteps, graded_shearing_follows_the_global_step) {
  const double coarse = 0.72e-4, end = 2e-6;
  Problem<2> model = graded_shearing(20.0, coarse);
  model.local.on = true;
  ExplicitSolver<2> local = at_rest(std::move(model)), global = at_rest(graded_shearing(20.0, coarse));
  double impulse[2] = {0.0, 0.0};
  constexpr int windows = 4;
  for (int w = 1; w <= windows; ++w) {
    double force[2];
    int i = 0;
    for (ExplicitSolver<2>* solver : {&global, &local}) {
      advance(*solver, end * w / windows);
      const double now = -solver->conditions().contact.results()[0].impulse.y();
      force[i] = (now - impulse[i]) / (end / windows);
      impulse[i] = now;
      ++i;
    }
    EXPECT_NEAR(force[1], force[0], 0.01 * force[0]) << "window " << w;
  }
  EXPECT_NEAR(impulse[1], impulse[0], 2e-3 * impulse[0]);
  ASSERT_EQ(local.sub_steps(), 8);
  const auto& levels = local.local_steps().level();
  EXPECT_LT(static_cast<double>(std::count(levels.begin(), levels.end(), 0)),
            0.2 * static_cast<double>(levels.size()));
  const EnergyLedger a = global.ledger(), b = local.ledger();
  EXPECT_NEAR(b["plastic"], a["plastic"], 2e-3 * a["plastic"]);
  EXPECT_NEAR(b.external(), a.external(), 2e-3 * a.external());
  EXPECT_NEAR(b["friction"], a["friction"], 0.02 * a["friction"]);
  EXPECT_NEAR(b["heat_generated"], a["heat_generated"], 2e-3 * a["heat_generated"]);
  EXPECT_LT(std::abs(b.residual()), 1e-3 * b.external());
  EXPECT_LT(std::abs(b.heat_residual()), 1e-9 * b["heat_generated"]);
  const Field &ea = global.state().point.plastic_strain, &eb = local.state().point.plastic_strain;
  EXPECT_NEAR(*std::max_element(eb.begin(), eb.end()), *std::max_element(ea.begin(), ea.end()),
              0.03 * *std::max_element(ea.begin(), ea.end()));
}

TEST(LocalSteps, same_bits_for_any_number_of_threads) {
  std::vector<Field> seen;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Problem<2> model = graded_shearing(40.0, 1.6e-4);
    model.local = {.on = true, .least_gain = 0.0};
    ExplicitSolver<2> solver = at_rest(std::move(model));
    advance(solver, 4e-7, 10);
    EXPECT_EQ(solver.sub_steps(), 8);
    seen.push_back(all_of(solver));
    seen.back().push_back(solver.ledger().total());
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
}

} // namespace
} // namespace cnem::testing
