#pragma once
// Loops over nodes and stress points in fixed blocks: results do not depend on the number of threads.
#include "core/index.hpp"

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <omp.h>
#include <vector>

namespace cnem {

inline constexpr std::size_t block_size = 512;

inline std::size_t blocks(std::size_t n) { return (n + block_size - 1) / block_size; }

/// Carries an exception out of a parallel region: one that left it by itself would end the program. Of
/// several it is that of the lowest part, whatever the number of threads.
class ParallelFailure {
public:
  template<class Body> void guard(std::ptrdiff_t part, Body&& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (failure_ && part_ <= part) return;
      failure_ = std::current_exception();
      part_ = part;
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

private:
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::ptrdiff_t part_ = 0;
};

/// body(part) for 0 … count - 1, shared out to the threads. Each begins with its own run of consecutive
/// parts, which is the same in every loop: what it reads was mostly written by the core it runs on. One that
/// is through takes over what others have left, since their cores may have other work. body must write only
/// to its part.
template<class Body> void for_each_part(std::ptrdiff_t count, Body&& body) {
  if (count == 1) return body(std::ptrdiff_t{0}); // no barrier where there is nothing to share
  const int threads = omp_get_max_threads();
  constexpr std::size_t cache_line = 64;
  struct alignas(cache_line) Run {
    std::atomic<std::ptrdiff_t> next;
    std::ptrdiff_t end;
  };
  std::vector<Run> runs(index_of(threads));
  for (int t = 0; t < threads; ++t) {
    runs[index_of(t)].next.store(count * t / threads, std::memory_order_relaxed);
    runs[index_of(t)].end = count * (t + 1) / threads;
  }
  ParallelFailure failure;
#pragma omp parallel
  for (int k = 0, own = omp_get_thread_num(); k < threads; ++k) {
    Run& run = runs[index_of((own + k) % threads)];
    for (std::ptrdiff_t part; (part = run.next.fetch_add(1, std::memory_order_relaxed)) < run.end;)
      failure.guard(part, [&] { body(part); });
  }
  failure.rethrow();
}

/// body(begin, end) for consecutive blocks of [0, n), shared out to the threads. body must write only to its
/// block.
template<class Body> void for_each_block(std::size_t n, Body&& body) {
  for_each_part(static_cast<std::ptrdiff_t>(blocks(n)), [&](std::ptrdiff_t b) {
    const std::size_t begin = index_of(b) * block_size;
    body(begin, begin + block_size < n ? begin + block_size : n);
  });
}

/// Sum of body(begin, end) over the blocks, added up in the order of the blocks.
template<class Body> double sum_blocks(std::size_t n, Body&& body) {
  std::vector<double> partial(blocks(n), 0.0);
  for_each_block(n,
                 [&](std::size_t begin, std::size_t end) { partial[begin / block_size] = body(begin, end); });
  double sum = 0.0;
  for (const double value : partial) sum += value;
  return sum;
}

/// Largest body(begin, end) over the blocks, and the block it came from first.
struct BlockMaximum {
  double value;
  std::size_t index; ///< whatever the body reported with it
};
template<class Body> BlockMaximum max_blocks(std::size_t n, Body&& body) {
  std::vector<BlockMaximum> partial(blocks(n), BlockMaximum{0.0, 0});
  for_each_block(n,
                 [&](std::size_t begin, std::size_t end) { partial[begin / block_size] = body(begin, end); });
  BlockMaximum best{0.0, 0};
  bool first = true;
  for (const BlockMaximum& candidate : partial)
    if (first || candidate.value > best.value || candidate.value != candidate.value) {
      best = candidate;
      first = false;
      if (candidate.value != candidate.value) break; // NaN wins: whoever asked must see it
    }
  return best;
}

} // namespace cnem
