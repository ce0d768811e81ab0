// Tetrahedra of a cloud whose boundary is held, ns per node: a jittered cube of about n nodes, with what the
// Delaunay triangulation takes of it; and the recovery of its boundary from random diagonals.
#include "tests/space_clouds.hpp"
#include "voronoi/space/delaunay.hpp"
#include "voronoi/space/triangulate.hpp"

#include <benchmark/benchmark.h>
#include <cmath>

namespace {

using cnem::Cloud;

Cloud<3> jittered_cube(std::int64_t n) {
  const int cells = static_cast<int>(std::lround(std::cbrt(static_cast<double>(n)))) - 1;
  return cnem::testing::unrecovered({.cells = cells, .jitter = 0.3});
}

void ns_per_node(benchmark::State& state, const Cloud<3>& cloud) {
  state.counters["per_node"] =
      benchmark::Counter(static_cast<double>(cloud.nodes()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void delaunay(benchmark::State& state) {
  const Cloud<3> cloud = cnem::voronoi::recover_boundary(jittered_cube(state.range(0))).cloud;
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::delaunay(cloud));
  ns_per_node(state, cloud);
}

void triangulate(benchmark::State& state) {
  const Cloud<3> cloud = cnem::voronoi::recover_boundary(jittered_cube(state.range(0))).cloud;
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::triangulate(cloud));
  ns_per_node(state, cloud);
}

void recover(benchmark::State& state) {
  const Cloud<3> cloud = jittered_cube(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::recover_boundary(cloud));
  ns_per_node(state, cloud);
}

BENCHMARK(delaunay)->Arg(2000)->Arg(20000)->Unit(benchmark::kMillisecond);
BENCHMARK(triangulate)->Arg(2000)->Arg(20000)->Unit(benchmark::kMillisecond);
BENCHMARK(recover)->Arg(2000)->Arg(20000)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
