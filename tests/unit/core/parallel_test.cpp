#include "core/machine/parallel.hpp"

#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

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

} // namespace
} // namespace cnem
