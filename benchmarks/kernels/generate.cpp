// Cost of generating clouds, ns per node.
#include "clouds/generate.hpp"

#include <benchmark/benchmark.h>
#include <cmath>

namespace {

using namespace cnem;
using namespace cnem::clouds;

DomainShape disc() {
  CurvePiece rim;
  rim.from = rim.to = Vec2(1, 0);
  rim.radius = 1.0;
  return {Curve{{rim}}, {}, {}};
}

void run(benchmark::State& state, const SpacingField& spacing) {
  const DomainShape domain = disc();
  double nodes = 0.0;
  for (auto _ : state) {
    const GeneratedCloud result = generate_cloud(domain, spacing, {});
    nodes = static_cast<double>(result.cloud.nodes());
    benchmark::DoNotOptimize(result.cloud.position.data());
  }
  state.counters["nodes"] = nodes;
  state.counters["ns/node"] = benchmark::Counter(1e-9 * nodes, benchmark::Counter::kIsIterationInvariantRate |
                                                                   benchmark::Counter::kInvert);
}

void uniform(benchmark::State& state) {
  run(state, {std::sqrt(3.63 / static_cast<double>(state.range(0))), {}});
}

void graded(benchmark::State& state) {
  const double h = std::sqrt(0.85 / static_cast<double>(state.range(0)));
  run(state, {8.0 * h, {{Refinement::Region::box, {{-0.5, -0.2}, {0.5, 0.2}}, h, 0.1}}});
}

BENCHMARK(uniform)->Arg(5000)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);
BENCHMARK(graded)->Arg(5000)->Arg(20000)->Arg(200000)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
