// Kinds of indices do not mix, and containers take no other kind than their own.
#include "core/indexed.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace cnem::testing {
namespace {

template<class From, class To>
constexpr bool converts = std::is_convertible_v<From, To> || std::is_assignable_v<To&, From>;
template<class Container, class Subscript>
constexpr bool takes = requires(Container container, Subscript subscript) {
  container[subscript];
};
template<class A, class B> constexpr bool compares = requires(A a, B b) { a == b; }
|| requires(A a, B b) { a < b; };

static_assert(!converts<NodeIndex, FacetIndex> && !converts<NodeIndex, BoundaryNodeIndex>);
static_assert(!converts<SimplexIndex, NodeIndex> && !converts<NodeIndex, SimplexIndex>);
static_assert(!converts<CloudFacetIndex, FacetIndex> && !converts<FacetIndex, CloudFacetIndex>);
static_assert(!converts<NodeIndex, std::int32_t> && !converts<NodeIndex, std::size_t>);
static_assert(!converts<std::int32_t, NodeIndex> && !converts<std::size_t, NodeIndex>);
static_assert(compares<NodeIndex, NodeIndex> && !compares<NodeIndex, FacetIndex>);
static_assert(sizeof(NodeIndex) == sizeof(std::int32_t));
static_assert(IndexKind<NodeIndex> && !IndexKind<std::int32_t>);

using PerNode = IndexedVector<NodeIndex, double>;
static_assert(takes<PerNode, NodeIndex> && takes<const PerNode, NodeIndex> && takes<PerNode, std::size_t>);
static_assert(!takes<PerNode, FacetIndex> && !takes<PerNode, BoundaryNodeIndex>);
static_assert(!takes<std::vector<double>, NodeIndex>);

using ViewPerNode = IndexedSpan<NodeIndex, const double>;
static_assert(takes<ViewPerNode, NodeIndex> && !takes<ViewPerNode, FacetIndex>);
static_assert(converts<PerNode, ViewPerNode> && !converts<std::vector<double>, ViewPerNode>);
static_assert(!converts<IndexedVector<FacetIndex, double>, ViewPerNode>);
static_assert(!converts<const PerNode, IndexedSpan<NodeIndex, double>>);
static_assert(!converts<std::vector<double>, PerNode> &&
              !converts<IndexedVector<FacetIndex, double>, PerNode>);

TEST(Index, goes_to_a_subscript_and_back) {
  for (const std::int32_t number : {0, 1, 7, std::numeric_limits<std::int32_t>::max()}) {
    const auto node = as<NodeIndex>(number);
    EXPECT_TRUE(exists(node));
    EXPECT_EQ(index_of(node), static_cast<std::size_t>(number));
    EXPECT_EQ(as<NodeIndex>(index_of(node)), node);
    EXPECT_EQ(as<std::int32_t>(node), number);
  }
  EXPECT_EQ(as<NodeIndex>(-1), NodeIndex::none);
  EXPECT_EQ(as<std::int64_t>(NodeIndex::none), -1);
  EXPECT_FALSE(exists(NodeIndex::none));
  EXPECT_EQ(NodeIndex{}, as<NodeIndex>(0));
}

TEST(Index, counts_what_it_indexes) {
  PerNode value{1.0, 2.0, 4.0};
  EXPECT_EQ(value.next(), as<NodeIndex>(3));
  double sum = 0.0;
  for (const NodeIndex i : value.indices()) {
    value[i] *= 10.0;
    sum += value[index_of(i)];
  }
  EXPECT_EQ(sum, 70.0);
  const ViewPerNode view = value;
  EXPECT_EQ(&view[as<NodeIndex>(2)], &value[2]);
  EXPECT_TRUE(PerNode().indices().begin() == PerNode().indices().end());
}

#ifndef NDEBUG
TEST(IndexDeathTest, none_is_no_subscript) {
  EXPECT_DEATH(index_of(NodeIndex::none), "number >= 0");
  EXPECT_DEATH(as<NodeIndex>(-2), "");
  EXPECT_DEATH(as<NodeIndex>(std::size_t{1} << 31U), "");
  EXPECT_DEATH(as<std::int32_t>(std::int64_t{1} << 31U), "");
}
#endif

} // namespace
} // namespace cnem::testing
