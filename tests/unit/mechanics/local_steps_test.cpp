// Local time steps against the global one.
#include "tests/unit/mechanics/graded.hpp"

#include <gtest/gtest.h>
#include <omp.h>

namespace cnem::testing {
namespace {

ExplicitSolver<2> at_rest(Model<2> model) {
  return start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
}

void advance(ExplicitSolver<2>& solver, double end, int rereference_every = 0) {
  double dt = 0.0;
  for (int n = 0; solver.state().time < end * (1.0 - 1e-9); ++n) {
    if (rereference_every > 0 && n % rereference_every == rereference_every - 1) solver.prepare();
    if (n % 4 == 0 || (rereference_every > 0 && n % rereference_every == rereference_every - 1))
      dt = solver.stable_step().dt;
    const double left = end - solver.state().time;
    solver.advance(left / std::ceil(left / dt * (1.0 - 1e-9)));
  }
}

/// All fields of a state, one after the other.
Field all_of(const ExplicitSolver<2>& solver) {
  const State<2>& s = solver.state();
  Field all;
  const auto add = [&](const Field& f) { all.insert(all.end(), f.begin(), f.end()); };
  for (const Fields<2>* f : {&s.node.position, &s.node.velocity, &s.node.force})
    for (const Field& component : *f) add(component);
  add(s.node.temperature);
  for (const Field& f : s.point.piola) add(f);
  add(s.point.plastic_strain);
  return all;
}

TEST(LocalSteps, one_level_gives_the_bits_of_the_global_step) {
  Model<2> global = graded_shearing(40.0), local = graded_shearing(40.0);
  local.local = {.on = true, .levels = 1, .least_gain = 0.0};
  ExplicitSolver<2> a = at_rest(std::move(global)), b = at_rest(std::move(local));
  advance(a, 5e-7, 30);
  advance(b, 5e-7, 30);
  EXPECT_EQ(a.state().step, b.state().step);
  EXPECT_EQ(all_of(a), all_of(b));
  EXPECT_EQ(a.ledger().total(), b.ledger().total());
  EXPECT_EQ(a.ledger().external(), b.ledger().external());
  EXPECT_EQ(a.model().contact.results()[0].force, b.model().contact.results()[0].force);
}

TEST(LocalSteps, momenta_are_exact) {
  const double omega = 2e4;
  const Vec2 drift(30.0, -10.0);
  Model<2> model = model_of(graded_rectangle(1e-2, 1e-2, 1e-3, 1.25e-4, {{5e-3, 4e-3}, {5e-3, 6e-3}}),
                            Method::cnem, steel());
  model.local.on = true;
  ExplicitSolver<2> solver = start(
      std::move(model), [&](const Vec2& x) -> Vec2 { return drift + omega * left_normal(x - Vec2(5e-3, 5e-3)); });
  const double dt = solver.stable_step().dt;
  solver.advance(dt);
  EXPECT_EQ(solver.sub_steps(), 8);
  const Momenta before = momenta(solver);
  const double energy = solver.ledger().initial;
  double worst = 0.0, mass = 0.0;
  const int steps = static_cast<int>(4.0 * 3.14159 / omega / dt);
  for (int n = 0; n < steps; ++n) {
    solver.advance(dt);
    if (n % 20 == 0) worst = std::max(worst, std::abs(solver.ledger().residual()));
  }
  const Momenta after = momenta(solver);
  for (const double m : solver.state().node.mass) mass += m;
  const double scale = mass * omega * 5e-3;
  std::printf("steps %d linear %g angular %g energy %g\n", steps, (after.linear - before.linear).norm() / scale,
              (after.angular - before.angular) / (scale * 1e-2), worst / energy);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-13 * scale * 10);
  EXPECT_NEAR(after.angular, before.angular, 1e-11 * scale * 1e-2);
  EXPECT_LT(worst, 1e-4 * energy);
}

TEST(LocalSteps, shear) {
  for (const bool on : {false, true}) {
    Model<2> m = graded_shearing(20.0, 2e-4);
    m.local.on = on;
    ExplicitSolver<2> s = at_rest(std::move(m));
    const double start_time = omp_get_wtime();
    double work = 0; int steps=0; double dt=0, worst=0, impulse=0;
    while (s.state().time < 10e-6) {
      if (steps % (on ? 2 : 10) == 0) dt = s.stable_step().dt;
      s.advance(dt); ++steps; work += s.updates();
      worst = std::max(worst, std::abs(s.ledger().residual()));
      if (steps % (on ? 150 : 1200) == 0) { const auto l = s.ledger();
        std::printf("t %g F %g plastic %g res %g ext %g heat %g/%g stab %g rel %g fric %g impact %g visc %g\n", s.state().time, -s.model().contact.results()[0].force.y(), l.plastic, l.residual(), l.external(), l.heat_generated,l.heat_residual(), l.stabilisation,l.penalty_release,l.friction,l.impact,l.viscosity); }
    }
    impulse = s.model().contact.results()[0].impulse.y();
    const auto l = s.ledger();
    std::printf("on %d nodes %zu steps %d sub %d updates %g worst %g of %g impulse %g plastic %g time %g\n", on, s.state().node.size(), steps, s.sub_steps(), work/double(s.state().node.size()), worst, l.external(), impulse, l.plastic, omp_get_wtime()-start_time);
    std::printf("t %.9g\n", s.state().time);
    { std::vector<int> count(6); for (auto v : s.local_steps().level()) ++count[static_cast<std::size_t>(v)]; for (int c : count) std::printf("%d ", c); std::printf("blocks\n"); }
  }
}

} // namespace
} // namespace cnem::testing
