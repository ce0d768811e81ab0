#include "core/machine/threads.hpp"
#include "core/index.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <latch>
#include <omp.h>
#include <system_error>
#include <thread>
#include <vector>

namespace cnem {

namespace {

/// Starts threads and lets them go. OpenMP ends the program when it does not get its threads; this throws.
void try_threads(int threads) {
  std::latch go(1);
  std::vector<std::jthread> started;
  started.reserve(index_of(threads));
  try {
    for (int k = 0; k < threads; ++k) started.emplace_back([&] { go.wait(); });
  } catch (const std::system_error& error) {
    go.count_down();
    throw IoError(
        fmt::format("cannot start {} threads: {} after {}; memory or the number of processes is limited: "
                    "use fewer with --threads",
                    threads + 1, error.code().message(), started.size() + 1));
  }
  go.count_down();
}

} // namespace

void check_threads(int threads, const char* what) {
  if (threads < 0)
    throw InputError(fmt::format("{}: found {}, expected 1 or more, or 0 for all there are", what, threads));
  const int cores = omp_get_num_procs(), most = std::max(64, 4 * cores);
  if (threads > most)
    throw InputError(fmt::format(
        "{}: found {}, expected at most {}: this machine has {} processors, and more threads than those "
        "make a run slower",
        what, threads, most, cores));
}

ThreadCount::ThreadCount(int threads) : before_(omp_get_max_threads()) {
  if (threads > 0) omp_set_num_threads(threads);
}
ThreadCount::~ThreadCount() { omp_set_num_threads(before_); }

void use_threads(int threads) {
  check_threads(threads, "--threads");
  if (threads > 0) omp_set_num_threads(threads);
  check_threads(omp_get_max_threads(), "environment variable OMP_NUM_THREADS");
  try_threads(omp_get_max_threads() - 1);
  int running = 0;
#pragma omp parallel reduction(+ : running)
  running += 1; // OpenMP's own stay from here on
}

} // namespace cnem
