// Local time steps against the global one: a graded shearing cloud, both solvers in turns over the same
// simulated time.
#include "benchmarks/models.hpp"
#include "contact/curve_shape.hpp"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <ctime>
#include <omp.h>

namespace {

using namespace cnem;
using namespace cnem::benchmarks;

contact::Tool<2> tool(const Vec2& low, const Vec2& high, double speed) {
  contact::Tool<2> made;
  made.name = "tool";
  made.shape = std::make_shared<contact::CurveShape>(testing::box(low, high));
  made.motion.velocity = {TimeTable(0.0), TimeTable(-speed)};
  made.friction = contact::Coulomb{0.1};
  return made;
}

/// Half a 304L blank, 10 × 4 mm, between punch, die and holder; the spacing grows from where it shears to
/// eight times as much.
ExplicitSolver<2> shearing(double coarse, bool local) {
  const double edge = 4e-3, clearance = 1e-4, thickness = 4e-3, width = 10e-3, speed = 20.0;
  clouds::SpacingField spacing;
  spacing.spacing = coarse;
  spacing.refinements = {{.points = {{edge, 0}, {edge, thickness}}, .spacing = coarse / 8.0, .growth = 0.3}};
  Problem<2> model = model_304L(testing::box({0, 0}, {width, thickness}, "side"), spacing);
  model.contact =
      contact::RigidContact<2>({tool({-1e-3, thickness}, {edge - clearance, 2 * thickness}, speed),
                                tool({edge + clearance, -thickness}, {12e-3, 0}, 0.0),
                                tool({edge + clearance, thickness}, {12e-3, 2 * thickness}, 0.0)});
  model.viscosity = {1.2, 0.06};
  model.local.on = local;
  Fields<2> velocity;
  resize_all(velocity, static_cast<std::size_t>(model.cloud.nodes()));
  return start<2>(std::move(model), std::move(velocity));
}

struct Seconds {
  double wall = 0.0, cpu = 0.0; ///< the latter of all threads: on a busy machine the one to compare
};

/// To a time, with the stable step looked at every ten finest steps.
Seconds advance(ExplicitSolver<2>& solver, double end) {
  const double begin = omp_get_wtime();
  const std::clock_t begin_cpu = std::clock();
  double dt = 0.0;
  int since = 10;
  while (solver.state().time < end * (1.0 - 1e-9)) {
    if (since >= 10) {
      dt = solver.stable_step().dt;
      since = 0;
    }
    since += solver.sub_steps();
    const double left = end - solver.state().time;
    solver.advance(left / std::ceil(left / dt * (1.0 - 1e-9)));
  }
  return {omp_get_wtime() - begin, static_cast<double>(std::clock() - begin_cpu) / CLOCKS_PER_SEC};
}

/// What no scheme can beat that takes each stress point at its own power of two.
double ceiling(const ExplicitSolver<2>& solver, double& finest_share) {
  SpectralBound<2> bound;
  const State<2>& state = solver.state();
  const auto& elastic = solver.model().materials.front().elasticity;
  const Field modulus(state.point.size(), elastic.lambda() + 2.0 * elastic.mu());
  const auto each =
      bound.of_ranges(solver.approximation().mechanics, state.point.deformation, modulus, state.node.mass, 1);
  double highest = 0.0, updates = 0.0, finest = 0.0;
  for (const auto& point : each) highest = std::max(highest, point.value);
  for (const auto& point : each) {
    const double level = std::floor(0.5 * std::log2(highest / point.value));
    updates += std::exp2(-level);
    finest += level == 0.0;
  }
  finest_share = finest / static_cast<double>(each.size());
  return static_cast<double>(each.size()) / updates;
}

void local_against_global(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const double coarse = 1e-6 * static_cast<double>(state.range(0));
  ExplicitSolver<2> global = shearing(coarse, false), local = shearing(coarse, true);
  double time = 1e-6, steps = 0.0;
  Seconds global_s, local_s;
  const auto add = [](Seconds& sum, const Seconds& more) {
    sum.wall += more.wall;
    sum.cpu += more.cpu;
  };
  advance(local, time);
  advance(global, time);
  for (auto _ : state) {
    time += 1e-7;
    add(global_s, advance(global, time));
    const double begun = static_cast<double>(local.state().step);
    const Seconds taken = advance(local, time);
    steps += local.updates() * (static_cast<double>(local.state().step) - begun);
    add(local_s, taken);
    state.SetIterationTime(taken.wall);
  }
  double share = 0.0;
  const double best = ceiling(local, share);
  const auto nodes = static_cast<double>(local.state().node.size());
  state.counters["nodes"] = nodes;
  state.counters["finest_share"] = share;
  state.counters["ceiling"] = best;
  state.counters["levels"] = std::log2(local.sub_steps()) + 1.0;
  state.counters["updates_saved"] = nodes * local.sub_steps() / local.updates();
  state.counters["global_over_local"] = global_s.wall / local_s.wall;
  state.counters["global_over_local_cpu"] = global_s.cpu / local_s.cpu;
  state.counters["updates_per_s"] = steps / local_s.wall;
}
BENCHMARK(local_against_global)
    ->ArgNames({"coarse_um", "threads"})
    ->Args({56, 1})
    ->Args({56, 2})
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
