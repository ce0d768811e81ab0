// The least cut between two vertices of small graphs.
#include "adapt/space/least_cut.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

TEST(LeastCut, parts_a_chain_at_its_weakest_edge) {
  const std::vector<GraphEdge> chain{{0, 1, 3.0}, {1, 2, 1.0}, {3, 2, 2.0}}; // either way alike
  EXPECT_EQ(side_of_least_cut(4, chain, 0, 3), (std::vector<char>{1, 1, 0, 0}));
  EXPECT_EQ(side_of_least_cut(4, chain, 3, 0), (std::vector<char>{0, 0, 1, 1}));
}

TEST(LeastCut, takes_several_edges_where_they_weigh_less_than_one) {
  // 0 and 5 by two ways whose ends weigh more than their middles together
  const std::vector<GraphEdge> ways{{0, 1, 5.0}, {1, 2, 1.0}, {1, 3, 1.5},
                                    {2, 4, 2.0}, {3, 4, 2.0}, {4, 5, 3.0}};
  EXPECT_EQ(side_of_least_cut(6, ways, 0, 5), (std::vector<char>{1, 1, 0, 0, 0, 0}));
}

TEST(LeastCut, leaves_what_neither_reaches_to_the_sink) {
  const std::vector<GraphEdge> edges{{0, 1, 1.0}, {2, 3, 1.0}, {4, 5, 1.0}};
  const std::vector<char> with_source = side_of_least_cut(6, edges, 0, 3);
  EXPECT_EQ(with_source, (std::vector<char>{1, 1, 0, 0, 0, 0}));
}

} // namespace
} // namespace cnem::adapt
