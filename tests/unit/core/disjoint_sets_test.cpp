// What is joined has one first member, the lowest.
#include "core/disjoint_sets.hpp"

#include <gtest/gtest.h>
#include <utility>

namespace cnem {
namespace {

TEST(DisjointSets, the_lowest_stands_for_what_is_joined) {
  DisjointSets sets(10);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(sets.first(i), i);
  constexpr std::pair<std::size_t, std::size_t> pairs[] = {{9, 7}, {3, 5}, {7, 5}, {1, 2}, {3, 9}};
  for (const auto& [a, b] : pairs) sets.join(a, b);
  constexpr std::size_t expected[] = {0, 1, 1, 3, 4, 3, 6, 3, 8, 3};
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(sets.first(i), expected[i]) << i;
}

} // namespace
} // namespace cnem
