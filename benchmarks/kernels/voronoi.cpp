// Geometry kernels, ns per node: triangulation of a jittered square in Hilbert order.
#include "voronoi/order.hpp"
#include "voronoi/triangulation.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <random>

namespace {

using cnem::Cloud;

/// About n nodes in the unit square, jittered by 0.3 of the spacing, in Hilbert order.
Cloud<2> jittered_square(std::int64_t n) {
  const int m = static_cast<int>(std::lround(std::sqrt(static_cast<double>(n))));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  Cloud<2> cloud;
  cloud.piece_names = {"boundary"};
  const double h = 1.0 / m;
  for (int k = 0; k < m; ++k) cloud.position.emplace_back(k * h, 0.0);
  for (int k = 0; k < m; ++k) cloud.position.emplace_back(1.0, k * h);
  for (int k = 0; k < m; ++k) cloud.position.emplace_back(1.0 - k * h, 1.0);
  for (int k = 0; k < m; ++k) cloud.position.emplace_back(0.0, 1.0 - k * h);
  for (int k = 0; k < 4 * m; ++k) cloud.facets.push_back({{k, (k + 1) % (4 * m)}, 0});
  for (int y = 1; y < m; ++y)
    for (int x = 1; x < m; ++x)
      cloud.position.emplace_back((x + jitter(random)) * h, (y + jitter(random)) * h);
  return cnem::voronoi::renumber(cloud, cnem::voronoi::hilbert_order(cloud.position));
}

void ns_per_node(benchmark::State& state, const Cloud<2>& cloud) {
  state.counters["per_node"] =
      benchmark::Counter(static_cast<double>(cloud.nodes()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void hilbert_order(benchmark::State& state) {
  const auto cloud = jittered_square(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::hilbert_order(cloud.position));
  ns_per_node(state, cloud);
}
BENCHMARK(hilbert_order)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

void triangulate(benchmark::State& state) {
  const auto cloud = jittered_square(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::triangulate(cloud));
  ns_per_node(state, cloud);
}
BENCHMARK(triangulate)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
