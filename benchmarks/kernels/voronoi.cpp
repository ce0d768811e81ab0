// Geometry kernels, ns per node: a jittered square in Hilbert order is triangulated, cut into cells, and the
// functions are evaluated once on every cell facet, as a rebuild of the operators does with one Gauss point.
#include "voronoi/order.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/natural_neighbours.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <benchmark/benchmark.h>
#include <cmath>
#include <random>

namespace {

using cnem::as;
using cnem::Cloud;
using cnem::NodeIndex;

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
  for (int k = 0; k < 4 * m; ++k)
    cloud.facets.push_back({{as<NodeIndex>(k), as<NodeIndex>((k + 1) % (4 * m))}, {}});
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

void circumcircles(benchmark::State& state) {
  const auto cloud = jittered_square(state.range(0));
  const auto mesh = cnem::voronoi::triangulate(cloud);
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::circumcircles(cloud, mesh));
  ns_per_node(state, cloud);
}
BENCHMARK(circumcircles)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

void constrained_cells(benchmark::State& state) {
  const auto cloud = jittered_square(state.range(0));
  const auto mesh = cnem::voronoi::triangulate(cloud);
  const auto circles = cnem::voronoi::circumcircles(cloud, mesh);
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::constrained_cells(cloud, mesh, circles));
  ns_per_node(state, cloud);
}
BENCHMARK(constrained_cells)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

void cell_geometry(benchmark::State& state) {
  const auto cloud = jittered_square(state.range(0));
  const auto mesh = cnem::voronoi::triangulate(cloud);
  const auto circles = cnem::voronoi::circumcircles(cloud, mesh);
  const auto cells = cnem::voronoi::constrained_cells(cloud, mesh, circles);
  for (auto _ : state) benchmark::DoNotOptimize(cnem::voronoi::cell_geometry(cloud, mesh, circles, cells));
  ns_per_node(state, cloud);
}
BENCHMARK(cell_geometry)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

void functions_on_facets(benchmark::State& state, cnem::voronoi::Functions functions) {
  const auto cloud = jittered_square(state.range(0));
  const auto mesh = cnem::voronoi::triangulate(cloud);
  const auto circles = cnem::voronoi::circumcircles(cloud, mesh);
  const auto cells = cnem::voronoi::constrained_cells(cloud, mesh, circles);
  cnem::voronoi::NaturalNeighbours at(cloud, mesh, circles);
  for (auto _ : state)
    for (const auto& facet : cells.interior) {
      at.evaluate_on_facet(functions, 0.5 * (facet.corner[0] + facet.corner[1]), facet.simplex);
      benchmark::DoNotOptimize(at.values().data());
    }
  ns_per_node(state, cloud);
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(cells.interior.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(functions_on_facets, sibson, cnem::voronoi::Functions::sibson)
    ->Arg(20000)
    ->Arg(200000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(functions_on_facets, laplace, cnem::voronoi::Functions::laplace)
    ->Arg(20000)
    ->Arg(200000)
    ->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
