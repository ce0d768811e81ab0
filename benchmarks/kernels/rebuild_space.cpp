// Rebuild of all operators in space on a shaken cube, phase by phase, one thread: counter per_node (s,
// printed with its SI prefix). Run: OMP_NUM_THREADS=1 build/benchmark_rebuild_space
#include "cnem/median.hpp"
#include "cnem/space.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/conduction.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/triangulate.hpp"

#include <benchmark/benchmark.h>

#include <utility>

using namespace cnem;

namespace {

/// About 2·10⁴ nodes, shaken by 0.3 of the spacing, and what each phase starts from.
struct Geometry {
  Cloud<3> cloud = testing::recovered({.cells = 26, .jitter = 0.3}).cloud;
  voronoi::Tetrahedra mesh = voronoi::triangulate(cloud);
  voronoi::Circumspheres spheres = voronoi::circumspheres(cloud, mesh);
  voronoi::VoronoiCells cells = voronoi::voronoi_cells(cloud, mesh, spheres);

  static const Geometry& get() {
    static const Geometry geometry;
    return geometry;
  }
};

/// `body` uses up what `prepare` makes, which is not timed.
template<class Prepare, class Body> void per_node(benchmark::State& state, Prepare&& prepare, Body&& body) {
  for (auto _ : state) {
    state.PauseTiming();
    auto given = prepare();
    state.ResumeTiming();
    benchmark::DoNotOptimize(body(std::move(given)));
  }
  state.counters["per_node"] =
      benchmark::Counter(Geometry::get().cloud.nodes(),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template<class Body> void per_node(benchmark::State& state, Body&& body) {
  per_node(
      state, [] { return 0; }, [&](int) { return body(); });
}

void triangulate(benchmark::State& state) {
  per_node(state, [] { return voronoi::triangulate(Geometry::get().cloud); });
}

void cells(benchmark::State& state) {
  const auto& [cloud, mesh, spheres, cells] = Geometry::get();
  per_node(state, [&] { return voronoi::voronoi_cells(cloud, mesh, voronoi::circumspheres(cloud, mesh)); });
}

scni::FacetMeans means(const benchmark::State& state, voronoi::Circumspheres spheres) {
  const auto& [cloud, mesh, all_spheres, cells] = Geometry::get();
  return scni::facet_means(cloud, mesh, std::move(spheres), cells,
                           state.range(0) == 0 ? voronoi::Functions::sibson : voronoi::Functions::laplace,
                           state.range(1) == 1 ? scni::FacetRule::one_point
                                               : scni::FacetRule::one_a_triangle);
}

void functions_on_facets(benchmark::State& state) {
  per_node(
      state, [] { return Geometry::get().spheres; },
      [&](voronoi::Circumspheres spheres) { return means(state, std::move(spheres)); });
}

void smoothing_and_links(benchmark::State& state) {
  const auto& cells = Geometry::get().cells;
  const auto& cloud = Geometry::get().cloud;
  const std::vector<scni::Interface<3>> facet = means(state, Geometry::get().spheres).facet;
  per_node(
      state, [&] { return means(state, Geometry::get().spheres).means; },
      [&](scni::FaceMeans means_on_facets) {
        const auto of_cell = group_by_cell<FaceIndex>(
            cloud.position.size(), facet.size(), [&](std::size_t f) -> const auto& { return facet[f].cell; });
        const auto boundary = voronoi::thirds_of_facets(cloud);
        const auto linked = voronoi::neighbours(cloud.position.size(), cells.rings);
        const scni::FacesOfCells<3, scni::Interface<3>> faces{cells.volume, facet, of_cell, boundary, linked};
        return std::pair(scni::smoothed_gradients(cloud, faces, std::move(means_on_facets)),
                         scni::stabilisation_links(cloud, faces));
      });
}

void median_rows_and_links(benchmark::State& state) {
  const auto& cloud = Geometry::get().cloud;
  per_node(state, [&] {
    auto op = scni::median_gradients(cloud, Geometry::get().mesh);
    auto links = scni::median_links(cloud, op);
    return std::pair(std::move(op), std::move(links));
  });
}

void conduction(benchmark::State& state) {
  per_node(state, [] { return voronoi::conduction_pattern(Geometry::get().cloud, Geometry::get().mesh); });
}

void whole_median(benchmark::State& state) {
  scni::CnemInSpace method({scni::CellKind::median, voronoi::Functions::linear, 1});
  per_node(state, [&] { return method.rebuild(Geometry::get().cloud); });
}

void whole_voronoi(benchmark::State& state) {
  scni::CnemInSpace method({scni::CellKind::voronoi,
                            state.range(0) == 0 ? voronoi::Functions::sibson : voronoi::Functions::laplace,
                            static_cast<int>(state.range(1))});
  per_node(state, [&] { return method.rebuild(Geometry::get().cloud); });
}

void by_functions(benchmark::internal::Benchmark* b) {
  b->ArgNames({"laplace", "points"})->Unit(benchmark::kMillisecond);
  b->Args({1, 1})->Args({0, 1})->Args({0, 3});
}

} // namespace

BENCHMARK(triangulate)->Unit(benchmark::kMillisecond);
BENCHMARK(cells)->Unit(benchmark::kMillisecond);
BENCHMARK(functions_on_facets)->Apply(by_functions);
BENCHMARK(smoothing_and_links)->Apply(by_functions);
BENCHMARK(median_rows_and_links)->Unit(benchmark::kMillisecond);
BENCHMARK(conduction)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_median)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_voronoi)->Apply(by_functions);
BENCHMARK_MAIN();
