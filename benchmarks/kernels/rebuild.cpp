// Rebuild of all operators on a jittered square, phase by phase, one thread: counter per_node (s, printed
// with its SI prefix). Run: OMP_NUM_THREADS=1 build/benchmark_rebuild
#include "cnem/quadrature.hpp"
#include "cnem/scni.hpp"
#include "cnem/smoothing.hpp"
#include "methods/efg.hpp"
#include "methods/fe_simplices.hpp"
#include "methods/sph.hpp"
#include "tests/clouds.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/order.hpp"
#include "voronoi/plane/cells.hpp"

#include <benchmark/benchmark.h>

#include <utility>

using namespace cnem;

namespace {

/// n × n nodes on the unit square, inner ones jittered by a quarter of the spacing, in space-filling order.
Cloud<2> benchmark_cloud(std::int64_t nodes) {
  const auto n = static_cast<int>(std::lround(std::sqrt(static_cast<double>(nodes))));
  const double h = 1.0 / (n - 1);
  Cloud<2> cloud;
  testing::add_loop(cloud, testing::rectangle(1, 1), h);
  testing::Random random(1);
  for (int j = 1; j < n - 1; ++j)
    for (int i = 1; i < n - 1; ++i) {
      const double dx = random.uniform(-0.25, 0.25), dy = random.uniform(-0.25, 0.25);
      cloud.position.push_back({(i + dx) * h, (j + dy) * h});
    }
  return voronoi::renumber(cloud, voronoi::hilbert_order(cloud.position));
}

/// `body` uses up what `prepare` makes, which is not timed.
template<class Prepare, class Body>
void per_node(benchmark::State& state, const Cloud<2>& cloud, Prepare&& prepare, Body&& body) {
  for (auto _ : state) {
    state.PauseTiming();
    auto given = prepare();
    state.ResumeTiming();
    benchmark::DoNotOptimize(body(std::move(given)));
  }
  state.counters["per_node"] = benchmark::Counter(
      cloud.nodes(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template<class Body> void per_node(benchmark::State& state, const Cloud<2>& cloud, Body&& body) {
  per_node(
      state, cloud, [] { return 0; }, [&](int) { return body(); });
}

void triangulate(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  per_node(state, cloud, [&] { return voronoi::triangulate(cloud); });
}

/// What the later phases start from.
struct Geometry {
  explicit Geometry(std::int64_t nodes)
      : cloud(benchmark_cloud(nodes)), triangulation(voronoi::triangulate(cloud)),
        circles(voronoi::circumcircles(cloud, triangulation)),
        cells(voronoi::constrained_cells(cloud, triangulation, circles)) {}
  Cloud<2> cloud;
  voronoi::Triangulation triangulation;
  voronoi::Circumcircles circles;
  voronoi::Cells cells;
};

scni::Options options(const benchmark::State& state) {
  scni::Options options{state.range(2) == 1 ? scni::Functions::laplace : scni::Functions::sibson,
                        static_cast<int>(state.range(1))};
  if (state.range(2) == 2) options.support = 2.5;
  return options;
}

scni::FaceMeans face_means(const Geometry& g, const scni::Options& o) {
  if (o.support) return scni::face_means(g.cloud, g.cells, *o.support, o.gauss_points);
  return scni::face_means(g.cloud, g.triangulation, g.circles, g.cells, o.functions, o.gauss_points);
}

void cells(benchmark::State& state) {
  const Geometry g(state.range(0));
  per_node(state, g.cloud, [&] {
    return voronoi::constrained_cells(g.cloud, g.triangulation,
                                      voronoi::circumcircles(g.cloud, g.triangulation));
  });
}

void cell_geometry(benchmark::State& state) {
  const Geometry g(state.range(0));
  per_node(state, g.cloud,
           [&] { return voronoi::cell_geometry(g.cloud, g.triangulation, g.circles, g.cells); });
}

void functions_on_facets(benchmark::State& state) {
  const Geometry g(state.range(0));
  per_node(state, g.cloud, [&] { return face_means(g, options(state)); });
}

void smoothing(benchmark::State& state) {
  const Geometry g(state.range(0));
  per_node(
      state, g.cloud, [&] { return face_means(g, options(state)); },
      [&](scni::FaceMeans given) {
        return scni::smoothed_gradients<2>(g.cloud, g.cells, faces_of_cells<2>(g.cells), std::move(given));
      });
}

void links(benchmark::State& state) {
  const Geometry g(state.range(0));
  const auto faces = faces_of_cells<2>(g.cells);
  per_node(state, g.cloud, [&] { return scni::stabilisation_links<2>(g.cloud, g.cells, faces); });
}

void linear_simplices(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  const auto triangulation = voronoi::triangulate(cloud);
  per_node(state, cloud, [&] { return voronoi::linear_simplices<2>(cloud, triangulation.node); });
}

void whole_cnem(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  scni::Cnem method(options(state));
  per_node(state, cloud, [&] { return method.rebuild(cloud); });
}

void whole_triangles(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  methods::FeTriangles method;
  per_node(state, cloud, [&] { return method.rebuild(cloud); });
}

void whole_efg(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  methods::Efg method;
  per_node(state, cloud, [&] { return method.rebuild(cloud); });
}

void whole_particles(benchmark::State& state) {
  const auto cloud = benchmark_cloud(state.range(0));
  methods::Sph method;
  per_node(state, cloud, [&] { return method.rebuild(cloud); });
}

void by_nodes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"nodes"})->Arg(20'000)->Arg(200'000)->Unit(benchmark::kMillisecond);
}

void by_nodes_and_rule(benchmark::internal::Benchmark* b) {
  // functions: 0 Sibson's, 1 Laplace's, 2 moving least squares
  b->ArgNames({"nodes", "points", "functions"})->Unit(benchmark::kMillisecond);
  b->ArgsProduct({{20'000, 200'000}, {1, 2, 3}, {0}})->ArgsProduct({{20'000}, {2}, {1, 2}});
}

} // namespace

BENCHMARK(triangulate)->Apply(by_nodes);
BENCHMARK(cells)->Apply(by_nodes);
BENCHMARK(linear_simplices)->Apply(by_nodes);
BENCHMARK(cell_geometry)->Apply(by_nodes);
BENCHMARK(links)->Apply(by_nodes);
BENCHMARK(functions_on_facets)->Apply(by_nodes_and_rule);
BENCHMARK(smoothing)->Apply(by_nodes_and_rule);
BENCHMARK(whole_cnem)->Apply(by_nodes_and_rule);
BENCHMARK(whole_triangles)->Apply(by_nodes);
BENCHMARK(whole_particles)->Apply(by_nodes);
BENCHMARK(whole_efg)->Apply(by_nodes);
BENCHMARK_MAIN();
