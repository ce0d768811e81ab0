// What a node costs from a thousand nodes to a million: time of a step, of a rebuild, memory. One command:
//   build/growth [--cells plane|median|voronoi] [--to 1000000 | --sizes 20000 ...] [--threads N]
//     [--output results/growth]
// in the plane, or in space with median or Voronoi cells, writes growth.csv, growth.md and growth.svg. Each
// size runs in a process of its own, whose peak memory it is. One thread is timed by its processor time,
// which others on the machine disturb least, several by the wall.
#include "benchmarks/sheared_block.hpp"
#include "core/error.hpp"
#include "core/machine/clock.hpp"
#include "report/chart.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <omp.h>
#include <optional>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

using namespace cnem;

struct Cost {
  double nodes = 0.0;
  double step = 0.0;    ///< s per node and step
  double rebuild = 0.0; ///< s per node
  double memory = 0.0;  ///< bytes per node at the peak, beyond those of an empty program
};

/// s; one thread: those that it had a core.
double clock_time() {
  if (omp_get_max_threads() > 1) return wall_time();
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Median of the seconds that work() takes: at least three times and for a second altogether.
template<class Work> double median_time(Work&& work) {
  std::vector<double> seconds;
  for (double sum = 0.0; seconds.size() < 3 || (sum < 1.0 && seconds.size() < 1000);) {
    const double start = clock_time();
    work();
    seconds.push_back(clock_time() - start);
    sum += seconds.back();
  }
  std::nth_element(seconds.begin(), seconds.begin() + std::ssize(seconds) / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

template<class MakeSolver> Cost measure(int nodes, const MakeSolver& make) {
  const auto before = static_cast<double>(results::peak_rss_bytes());
  auto solver = make(nodes);
  const auto count = static_cast<double>(solver.state().node.size());
  double dt = solver.stable_step().dt;
  while (solver.state().time < 4e-7) solver.advance(dt); // past the elastic limit everywhere
  const double rebuild = median_time([&] { solver.prepare(); });
  const double ten_steps = median_time([&] {
    dt = solver.stable_step().dt;
    for (int k = 0; k < 10; ++k) solver.advance(dt);
  });
  return {count, ten_steps / 10.0 / count, rebuild / count,
          (static_cast<double>(results::peak_rss_bytes()) - before) / count};
}

auto in_space(scni::CellKind cells) {
  return [cells](int nodes) { return benchmarks::sheared_block_in_space(nodes, cells); };
}

/// What is measured, by the name of its cells.
const std::map<std::string, std::function<Cost(int nodes)>>& measures() {
  static const std::map<std::string, std::function<Cost(int nodes)>> named{
      {"plane", [](int nodes) { return measure(nodes, benchmarks::sheared_block); }},
      {"median", [](int nodes) { return measure(nodes, in_space(scni::CellKind::median)); }},
      {"voronoi", [](int nodes) { return measure(nodes, in_space(scni::CellKind::voronoi)); }}};
  return named;
}

/// The measure in a process of its own; none when it failed.
std::optional<Cost> measure_apart(const std::string& cells, int nodes, int threads) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    int failed = 1;
    try {
      if (threads > 0) omp_set_num_threads(threads);
      const Cost cost = measures().at(cells)(nodes);
      failed = write(ends[1], &cost, sizeof cost) != static_cast<ssize_t>(sizeof cost);
    } catch (const std::exception& error) { fmt::print(stderr, "{} nodes: {}\n", nodes, error.what()); }
    _exit(failed);
  }
  close(ends[1]);
  Cost cost;
  const bool whole = child > 0 && read(ends[0], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return whole ? std::optional(cost) : std::nullopt;
}

/// All costs in one chart.
report::Chart chart_of(const std::vector<Cost>& costs, const std::string& cells, int threads) {
  report::Chart chart;
  chart.title =
      fmt::format("Cost per node, {}, {} {}", cells == "plane" ? cells : "space, " + cells + " cells",
                  threads, threads == 1 ? "thread" : "threads");
  chart.x_label = "nodes";
  chart.x_unit = "";
  chart.y_label = "ns per node and step, ns per node, bytes per node";
  chart.log_x = chart.log_y = true;
  chart.series = {{"step", {}, {}, 0}, {"rebuild", {}, {}, 1}, {"peak memory", {}, {}, 2}};
  for (const Cost& cost : costs) {
    for (report::ChartSeries& series : chart.series) series.x.push_back(cost.nodes);
    chart.series[0].y.push_back(1e9 * cost.step);
    chart.series[1].y.push_back(1e9 * cost.rebuild);
    chart.series[2].y.push_back(cost.memory);
  }
  return chart;
}

int run(const std::string& cells, const std::vector<int>& sizes, int threads,
        const std::filesystem::path& output) {
  if (threads == 0) threads = omp_get_max_threads();
  std::filesystem::create_directories(output);
  std::string csv = "nodes,threads,step[ns/(node step)],rebuild[ns/node],peak_memory[B/node]\n";
  std::string markdown =
      "| nodes | step, ns per node and step | rebuild, ns per node | peak memory, bytes per node |\n"
      "| --- | --- | --- | --- |\n";
  std::vector<Cost> costs;
  for (const int nodes : sizes) {
    const std::optional<Cost> cost = measure_apart(cells, nodes, threads);
    if (!cost) return 1;
    costs.push_back(*cost);
    csv += fmt::format("{:.0f},{},{:.4g},{:.5g},{:.5g}\n", cost->nodes, threads, 1e9 * cost->step,
                       1e9 * cost->rebuild, cost->memory);
    const std::string row = fmt::format("| {:.0f} | {:.1f} | {:.0f} | {:.0f} |\n", cost->nodes,
                                        1e9 * cost->step, 1e9 * cost->rebuild, cost->memory);
    if (costs.size() == 1) fmt::print("{}", markdown);
    fmt::print("{}", row);
    std::fflush(stdout); // before the next process copies it
    markdown += row;
  }
  results::write_atomically(output / "growth.csv", csv);
  results::write_atomically(output / "growth.md", markdown);
  results::write_atomically(output / "growth.svg", report::svg_file(chart_of(costs, cells, threads)));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  CLI::App program("Time of steps and rebuilds and memory per node, from a thousand nodes to a million",
                   "growth");
  int to = 1000000, threads = 0;
  std::vector<int> sizes;
  std::string cells = "plane", output = "results/growth";
  program.add_option("--cells", cells, "plane, or in space median or voronoi")
      ->check(CLI::IsMember(measures()));
  program.add_option("--to", to, "largest number of nodes")->check(CLI::PositiveNumber);
  program.add_option("--sizes", sizes, "these numbers of nodes")
      ->check(CLI::PositiveNumber)
      ->excludes("--to");
  program.add_option("--threads", threads, "number of threads (default: all)")->check(CLI::PositiveNumber);
  program.add_option("--output", output, "folder of results");
  CLI11_PARSE(program, argc, argv);
  try {
    if (sizes.empty())
      for (const int nodes : {1000, 3000, 10000, 30000, 100000, 300000, 1000000})
        if (nodes <= to) sizes.push_back(nodes);
    return run(cells, sizes, threads, output);
  } catch (const IoError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 4;
  }
}
