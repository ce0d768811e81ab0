#include "core/machine/parallel.hpp"
#include "core/machine/threads.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace cnem {
namespace {

// An exception that left a parallel region would end the program.
TEST(parallel, an_exception_leaves_a_parallel_loop_and_is_that_of_the_lowest_block) {
  for (int repetition = 0; repetition < 20; ++repetition) {
    try {
      for_each_block(20 * block_size, [](std::size_t begin, std::size_t) {
        if (begin >= 3 * block_size) throw std::runtime_error(std::to_string(begin / block_size));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) { EXPECT_STREQ(error.what(), "3"); }
  }
}

TEST(parallel, every_part_is_done_once_with_any_number_of_threads_and_within_another_loop) {
  for (const int threads : {1, 2, 3, 7}) {
    const ThreadCount with(threads);
    for (const std::ptrdiff_t count : {0, 1, 2, 5, 40}) {
      std::vector<std::atomic<int>> done(index_of(count)), within(index_of(count));
      for_each_part(count, [&](std::ptrdiff_t part) { ++done[index_of(part)]; });
      for_each_part(4, [&](std::ptrdiff_t) {
        for_each_part(count, [&](std::ptrdiff_t part) { ++within[index_of(part)]; });
      });
      for (const auto& times : done) EXPECT_EQ(times, 1) << threads << " threads, " << count << " parts";
      for (const auto& times : within) EXPECT_EQ(times, 4) << threads << " threads, " << count << " parts";
    }
  }
}

// A core that has other work must not hold up the loop.
TEST(parallel, what_a_slow_thread_has_left_is_taken_over) {
  const ThreadCount with(2);
  constexpr std::ptrdiff_t count = 40;
  std::atomic<std::ptrdiff_t> done = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  for_each_part(count, [&](std::ptrdiff_t part) {
    if (part == 0)
      while (done < count - 1 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    else
      ++done;
  });
  EXPECT_LT(std::chrono::steady_clock::now(), deadline);
}

} // namespace
} // namespace cnem
