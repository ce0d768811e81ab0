// The whole explicit step: Johnson-Cook flowing plastically in every node, stabilisation and heat on.
#include "benchmarks/sheared_block.hpp"

#include <benchmark/benchmark.h>
#include <omp.h>

#include <string>
#include <utility>

namespace {

using namespace cnem;

template<int dim> void measure(benchmark::State& state, auto&& make) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  ExplicitSolver<dim> solver = make(static_cast<int>(state.range(0)));
  double dt = solver.stable_step().dt;
  while (solver.state().time < 4e-7) solver.advance(dt); // past the elastic limit everywhere
  const StepTimes before = solver.times();
  std::int64_t count = 0;
  for (auto _ : state) {
    if (++count % 10 == 0) dt = solver.stable_step().dt;
    solver.advance(dt);
  }
  const DiscreteOperators<dim>& op = solver.approximation().mechanics;
  state.counters["entries_a_row"] = static_cast<double>(op.node.size()) / op.points;
  double flowing = 0.0;
  for (const double r : solver.state().point.plastic_rate) flowing += r > 0.0;
  const auto nodes = static_cast<double>(solver.state().node.size());
  state.counters["nodes"] = nodes;
  state.counters["flowing"] = flowing / nodes;
  state.counters["node_steps_per_s"] =
      benchmark::Counter(nodes * static_cast<double>(count), benchmark::Counter::kIsRate);
  const StepTimes& times = solver.times();
  const std::pair<const char*, double> parts[] = {{"motion_ns", times.motion - before.motion},
                                                  {"stress_ns", times.stress - before.stress},
                                                  {"forces_ns", times.forces - before.forces},
                                                  {"heat_ns", times.heat - before.heat}};
  for (const auto& [name, seconds] : parts)
    state.counters[name] = 1e9 * seconds / (nodes * static_cast<double>(count));
}

void explicit_step(benchmark::State& state) { measure<2>(state, benchmarks::sheared_block); }
void step_on_median_cells(benchmark::State& state) {
  measure<3>(state,
             [](int nodes) { return benchmarks::sheared_block_in_space(nodes, scni::CellKind::median); });
}
void step_on_voronoi_cells(benchmark::State& state) {
  measure<3>(state,
             [](int nodes) { return benchmarks::sheared_block_in_space(nodes, scni::CellKind::voronoi); });
}

void sizes(benchmark::internal::Benchmark* step) {
  step->ArgNames({"nodes", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
  for (const int nodes : {20000, 200000})
    for (const int threads : {1, 2}) step->Args({nodes, threads});
}
BENCHMARK(explicit_step)->Apply(sizes);
BENCHMARK(step_on_median_cells)->Apply(sizes);
BENCHMARK(step_on_voronoi_cells)->Apply(sizes);

} // namespace

BENCHMARK_MAIN();
